// Tables that sort, plots that are chosen, settings that stand out under the pointer.

function sortBy(table, column, head) {
  const up = head.dataset.sorted === "down";
  for (const other of table.tHead.rows[0].cells) delete other.dataset.sorted;
  head.dataset.sorted = up ? "up" : "down";
  const key = (row) => Number(row.cells[column].dataset.value ?? 0);
  const text = (row) => row.cells[column].textContent;
  const rows = [...table.tBodies[0].rows].sort((a, b) => column === 0 ? text(a).localeCompare(text(b)) : key(a) - key(b));
  table.tBodies[0].append(...(up ? rows.reverse() : rows));
}

for (const table of document.querySelectorAll("table.sortable")) {
  [...table.tHead.rows[0].cells].forEach((head, column) => { head.onclick = () => sortBy(table, column, head); });
}

function choosePlot(plots, axis, metric) {
  Object.assign(plots.dataset, {axis, metric});
  for (const element of plots.querySelectorAll(".plot")) element.classList.toggle("on", element.dataset.axis === axis && element.dataset.metric === metric);
  for (const button of plots.querySelectorAll("button")) button.classList.toggle("on", button.dataset.axis === axis || button.dataset.metric === metric);
}

for (const plots of document.querySelectorAll(".plots")) {
  for (const button of plots.querySelectorAll("button")) {
    button.onclick = () => choosePlot(plots, button.dataset.axis ?? plots.dataset.axis, button.dataset.metric ?? plots.dataset.metric);
  }
  choosePlot(plots, plots.querySelector("button[data-axis]").dataset.axis, "mse");
}

/** Dims all settings of a section but one; -1: none. */
function standOut(section, setting) {
  for (const part of section.querySelectorAll(".plot svg g[id]")) {
    const found = part.id.match(/-s(\d+)-/);
    if (found) part.style.opacity = setting < 0 || Number(found[1]) === setting ? 1 : 0.12;
  }
}

for (const section of document.querySelectorAll("section[data-scene]")) {
  for (const row of section.querySelectorAll("tr[data-setting]")) {
    row.onmouseenter = () => standOut(section, Number(row.dataset.setting));
    row.onmouseleave = () => standOut(section, -1);
  }
  const viewer = section.querySelector(".viewer");
  if (viewer) new Viewer(viewer, JSON.parse(section.querySelector("script.pictures").textContent));
}
