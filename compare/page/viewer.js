// Linked pictures: all panes show one part of the image, at one exposure or on one scale.
"use strict";

/** A half float as a number. */
function fromHalf(bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

const HALVES = Float32Array.from({length: 65536}, (_, bits) => fromHalf(bits));

function bytesOf(text) {
  return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
}

/** What report.packed() wrote, as floats. */
async function unpack(text) {
  const stream = new Blob([bytesOf(text)]).stream().pipeThrough(new DecompressionStream("deflate"));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = planes.length / 2, out = new Float32Array(count);
  for (let i = 0; i < count; ++i) out[i] = HALVES[(planes[i] << 8) | planes[count + i]];
  return out;
}

function encodeSrgb(v) {
  return 255 * (v <= 0.0031308 ? 12.92 * Math.max(0, v) : 1.055 * Math.min(1, v) ** (1 / 2.4) - 0.055);
}

// Square roots of values are spread evenly enough for a table of the sRGB curve.
const SRGB = Uint8ClampedArray.from({length: 4097}, (_, i) => Math.round(encodeSrgb((i / 4096) ** 2)));

function shortNumber(v) {
  if (!Number.isFinite(v)) return "–";
  const size = Math.abs(v);
  return v === 0 ? "0" : size >= 1e-3 && size < 1e4 ? v.toPrecision(3) : v.toExponential(1);
}

/** One layer of one setting: its values, and the picture of them that was drawn last. */
class Layer {
  constructor(packedText, width, height) {
    this.packedText = packedText;
    this.width = width;
    this.height = height;
    this.drawnAs = "";
  }

  async load() {
    if (!this.values) this.values = await unpack(this.packedText);
    this.channels = this.values.length / (this.width * this.height);
  }

  at(x, y, channel) {
    return this.values[(y * this.width + x) * this.channels + channel];
  }

  /** The picture under a look {kind, span or exposure}, with the colours of `table`; drawn again only when that changed. */
  canvas(look, table) {
    const key = JSON.stringify(look);
    if (this.drawnAs === key) return this.picture;
    this.drawnAs = key;
    this.picture = this.picture || Object.assign(document.createElement("canvas"), {width: this.width, height: this.height});
    const context = this.picture.getContext("2d"), data = context.createImageData(this.width, this.height);
    if (look.kind === "picture") this.fillPicture(data.data, 2 ** look.exposure);
    else this.fillMap(data.data, look.span, table);
    context.putImageData(data, 0, 0);
    return this.picture;
  }

  fillPicture(out, factor) {
    for (let i = 0, j = 0; i < this.values.length; i += 3, j += 4) {
      for (let c = 0; c < 3; ++c) out[j + c] = SRGB[Math.round(4096 * Math.sqrt(Math.min(1, Math.max(0, this.values[i + c] * factor))))];
      out[j + 3] = 255;
    }
  }

  fillMap(out, [low, high], table) {
    for (let i = 0; i < this.values.length; ++i) {
      const at = 3 * Math.round(255 * Math.min(1, Math.max(0, (this.values[i] - low) / (high - low))));
      out[4 * i] = table[at];
      out[4 * i + 1] = table[at + 1];
      out[4 * i + 2] = table[at + 2];
      out[4 * i + 3] = 255;
    }
  }
}

/** The panes of a scene and what is said to them. */
class Viewer {
  constructor(root, content) {
    this.root = root;
    this.content = content;
    const {width, height} = content;
    this.size = {width, height};
    this.pictures = content.images.map((image) => new Layer(image.data, width, height));
    this.maps = content.maps.map((map) => map.data.map((data) => new Layer(data, width, height)));
    this.view = {x: width / 2, y: height / 2, zoom: 1};
    this.mode = -1;  // a number of `maps`, -1: the pictures
    this.stops = {picture: content.exposure, map: 0};  // exposure, and how far the scale of the maps is moved
    this.layout = "grid";
    this.sides = [content.images.length > 1 ? 1 : 0, 0];
    this.split = 0.5;
    this.build();
    this.show();
  }

  element(tag, parent, fields = {}) {
    const found = Object.assign(document.createElement(tag), fields);
    parent.append(found);
    return found;
  }

  build() {
    const bar = this.element("div", this.root, {className: "bar"});
    this.modes = [-1, ...this.maps.keys()].map((mode) => {
      const title = mode < 0 ? "Picture" : this.content.maps[mode].title;
      const button = this.element("button", bar, {textContent: title, title: mode < 0 ? "" : this.content.maps[mode].words});
      button.onclick = () => { this.mode = mode; this.show(); };
      return button;
    });
    const tools = this.element("div", this.root, {className: "bar"});
    this.layouts = ["grid", "slider"].map((layout) => {
      const button = this.element("button", tools, {textContent: layout});
      button.onclick = () => { this.layout = layout; this.show(); };
      return button;
    });
    this.choices = [0, 1].map((side) => {
      const select = this.element("select", tools, {title: side ? "right" : "left"});
      this.content.images.forEach((image, i) => this.element("option", select, {value: i, textContent: image.name}));
      select.onchange = () => { this.sides[side] = Number(select.value); this.show(); };
      return select;
    });
    const label = this.element("label", tools);
    this.stopsTitle = this.element("span", label);
    this.slider = this.element("input", label, {type: "range", min: -8, max: 8, step: 0.25});
    this.stopsNumber = this.element("span", label);
    this.slider.oninput = () => { this.stops[this.kind()] = Number(this.slider.value); this.drawScale(); this.draw(); };
    const fit = this.element("button", tools, {textContent: "fit"});
    fit.onclick = () => { this.view = {x: this.size.width / 2, y: this.size.height / 2, zoom: 1}; this.draw(); };
    const close = this.element("button", tools, {textContent: "8 ×"});
    close.onclick = () => { this.view.zoom = 8; this.draw(); };
    this.scale = this.element("div", this.root, {className: "scale"});
    this.panes = this.element("div", this.root, {className: "panes"});
    this.where = this.element("div", this.root, {className: "where"});
    new ResizeObserver(() => this.draw()).observe(this.panes);
  }

  /** What a pane shows: its name and layer. Maps have no reference. */
  shown(index) {
    const name = this.content.images[index].name;
    if (this.mode < 0) return {name, layer: this.pictures[index]};
    return index === 0 ? null : {name, layer: this.maps[this.mode][index - 1]};
  }

  kind() {
    return this.mode < 0 ? "picture" : "map";
  }

  /** The ends of the scale: moved by stops as an exposure moves a picture. */
  span() {
    const map = this.content.maps[this.mode];
    return map.span.map((end) => map.kind === "log" ? end - this.stops.map * Math.log10(2) : end / 2 ** this.stops.map);
  }

  look() {
    if (this.mode < 0) return {kind: "picture", exposure: this.stops.picture};
    return {kind: this.content.maps[this.mode].kind, span: this.span()};
  }

  /** Makes the panes of the mode and the layout anew. */
  async show() {
    this.modes.forEach((button, i) => button.classList.toggle("on", i - 1 === this.mode));
    this.layouts.forEach((button) => button.classList.toggle("on", button.textContent === this.layout));
    this.choices.forEach((select, side) => {
      select.style.display = this.layout === "slider" ? "" : "none";
      if (this.mode >= 0 && this.sides[side] === 0) this.sides[side] = Math.min(side + 1, this.content.images.length - 1);
      select.options[0].disabled = this.mode >= 0;
      select.value = this.sides[side];
    });
    const wanted = this.content.images.map((_, i) => this.shown(i)).filter((s) => s);
    await Promise.all(wanted.map((s) => s.layer.load()));
    this.panes.replaceChildren();
    this.drawScale();
    if (this.layout === "slider") {
      this.panes.style.gridTemplateColumns = "1fr";
      const [left, right] = this.sides.map((i) => this.shown(i) || wanted[0]);
      this.drawn = [this.pane(`${left.name}  |  ${right.name}`, [left.layer, right.layer])];
    } else {
      const columns = Math.min(wanted.length, this.size.width > 1.6 * this.size.height ? 3 : 4);
      this.panes.style.gridTemplateColumns = `repeat(${columns}, minmax(0, 1fr))`;
      this.drawn = wanted.map((s) => this.pane(s.name, [s.layer]));
    }
    this.draw();
  }

  pane(name, layers) {
    const box = this.element("div", this.panes, {className: "pane"});
    const title = this.element("div", box, {className: "name"});
    this.element("b", title, {textContent: name});
    const value = this.element("span", title);
    const canvas = this.element("canvas", box);
    const found = {canvas, layers, value};
    this.listen(found);
    return found;
  }

  listen(pane) {
    const {canvas} = pane;
    canvas.onwheel = (event) => {
      event.preventDefault();
      const before = this.pixelAt(canvas, event);
      this.view.zoom = Math.min(64, Math.max(1, this.view.zoom * 1.0015 ** -event.deltaY));
      const after = this.pixelAt(canvas, event);
      this.view.x += before.x - after.x;
      this.view.y += before.y - after.y;
      this.draw();
    };
    canvas.onpointerdown = (event) => {
      canvas.setPointerCapture(event.pointerId);
      const bounds = canvas.getBoundingClientRect(), at = (event.clientX - bounds.left) / bounds.width;
      this.held = {splitting: pane.layers.length > 1 && Math.abs(at - this.split) * bounds.width < 12, x: event.clientX, y: event.clientY};
      canvas.classList.add("dragging");
    };
    canvas.onpointerup = () => { this.held = null; canvas.classList.remove("dragging"); };
    canvas.onpointermove = (event) => {
      const bounds = canvas.getBoundingClientRect();
      if (this.held && this.held.splitting) {
        this.split = Math.min(1, Math.max(0, (event.clientX - bounds.left) / bounds.width));
      } else if (this.held) {
        const factor = this.factor(canvas);
        this.view.x -= (event.clientX - this.held.x) / factor;
        this.view.y -= (event.clientY - this.held.y) / factor;
        Object.assign(this.held, {x: event.clientX, y: event.clientY});
      }
      if (this.held) this.draw();
      this.tell(this.pixelAt(canvas, event));
    };
  }

  /** Pixels of the page for a pixel of the image. */
  factor(canvas) {
    return canvas.clientWidth / this.size.width * this.view.zoom;
  }

  pixelAt(canvas, event) {
    const bounds = canvas.getBoundingClientRect(), factor = this.factor(canvas);
    return {x: this.view.x + (event.clientX - bounds.left - bounds.width / 2) / factor,
            y: this.view.y + (event.clientY - bounds.top - bounds.height / 2) / factor};
  }

  /** The values of one pixel in every pane. */
  tell(pixel) {
    const x = Math.floor(pixel.x), y = Math.floor(pixel.y);
    if (x < 0 || y < 0 || x >= this.size.width || y >= this.size.height) return;
    this.where.textContent = `pixel ${x}, ${y}`;
    const logarithmic = this.mode >= 0 && this.content.maps[this.mode].kind === "log";
    for (const {layers, value} of this.drawn) {
      value.textContent = layers.map((layer) => [...Array(layer.channels).keys()]
        .map((c) => layer.at(x, y, c)).map((v) => shortNumber(logarithmic ? 10 ** v : v)).join(" ")).join("  |  ");
    }
  }

  table(kind) {
    this.tables = this.tables || {};
    this.tables[kind] = this.tables[kind] || bytesOf(COLOURS[kind]);
    return this.tables[kind];
  }

  drawScale() {
    this.stopsTitle.textContent = this.mode < 0 ? "exposure" : "scale";
    this.stopsNumber.textContent = this.slider.value = this.stops[this.kind()];
    this.scale.replaceChildren();
    if (this.mode < 0) return;
    const map = this.content.maps[this.mode], table = this.table(map.kind);
    const ends = map.kind === "log" ? this.span().map((v) => 10 ** v) : this.span();
    this.element("span", this.scale, {textContent: shortNumber(ends[0])});
    const canvas = this.element("canvas", this.scale, {width: 256, height: 1}), context = canvas.getContext("2d");
    const data = context.createImageData(256, 1);
    for (let i = 0; i < 256; ++i) data.data.set([table[3 * i], table[3 * i + 1], table[3 * i + 2], 255], 4 * i);
    context.putImageData(data, 0, 0);
    this.element("span", this.scale, {textContent: shortNumber(ends[1])});
    this.element("span", this.scale, {textContent: `${map.words}; ${map.kind === "log" ? "logarithmic, " : ""}the same for all`});
  }

  draw() {
    if (!this.drawn) return;
    const look = this.look(), table = this.mode < 0 ? null : this.table(look.kind);
    const ratio = window.devicePixelRatio || 1;
    for (const {canvas, layers} of this.drawn) {
      const width = Math.round(canvas.clientWidth * ratio);
      if (width === 0) continue;
      const most = this.layout === "slider" ? 720 * ratio : Infinity;
      const height = Math.round(Math.min(most, width * this.size.height / this.size.width));
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
      const context = canvas.getContext("2d"), factor = this.factor(canvas) * ratio;
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.clearRect(0, 0, width, height);
      context.imageSmoothingEnabled = false;
      layers.forEach((layer, side) => {
        context.save();
        if (layers.length > 1) {
          context.beginPath();
          context.rect(side ? this.split * width : 0, 0, side ? width : this.split * width, height);
          context.clip();
        }
        context.drawImage(layer.canvas(look, table), width / 2 - this.view.x * factor, height / 2 - this.view.y * factor,
                          this.size.width * factor, this.size.height * factor);
        context.restore();
      });
      if (layers.length > 1) {
        context.fillStyle = "#fff";
        context.fillRect(this.split * width - ratio, 0, 2 * ratio, height);
      }
    }
  }
}
