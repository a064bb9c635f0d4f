// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/docs.h"

#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "base/parallel.h"
#include "base/writable.h"
#include "tools/medialab/docs_lists.h"
#include "tools/medialab/docs_measured.h"

namespace pbrtmedia {
namespace {

void printLab(std::ostream& out) {
  out << R"(
## The lab

`medialab COMMAND --help` tells all options; CSV and JSON begin with the command that repeats them. `--resume FILE` (of `estimate`,
`converge`, `heatmap`) keeps what is measured: the same command goes on where it was stopped or killed.

```
medialab list                                                                      # this page's first half, as text or JSON
medialab estimate --estimator all --extinction cosine --depth 1,4 --control 1,2    # mean, variance, cost, with errors
medialab heatmap --extinction gaussian -o gaussian                                 # over transmittance and control: CSV, EXR, PNG
medialab estimate --quantity reciprocal --extinction composite-sine --control 1,2    # unbiased estimates of 1 / depth
medialab heatmap --extinction gaussian-m22 --rows control --row-range 1 5 -o maps  # the axes of Misso et al. 2022
medialab converge --estimator ratio,unbiased-ray-marching -o converge.csv          # error against samples, look-ups, seconds
medialab profile --estimator ratio --supervoxels 8 --lower 1 --picture line.png    # one line, its controls, its look-ups
medialab heatmap --family slab --estimator p-series-cmf,unbiased-ray-marching -o slab # densities that get rougher, from clear to opaque
medialab levels --estimator debiased-ray-marching:levels=0:comb=independent        # variance and cost of corrections, level by level
medialab running --estimator ratio --extinction step-sine --depth 12.66 --to 3     # weights of walks along a line
medialab progressive --supervoxels 80 --epsilon 0.2                                # bounds that rise from pass to pass
medialab power-law --doublings 18                                                  # means whose variance is infinite
medialab stress -o stress.csv                                                      # all on stiff and extreme lines: ten minutes of processor time
medialab precision                                                                 # float against double where it matters
```
)";
}

}  // namespace

std::string docsPage(const DocsOptions& o, const StopSignal& stop) {
  std::ostringstream out;
  out << "# Transmittance estimators\n\n"
         "This page is generated: `"
      << o.lab.command
      << "`. It says what `medialab list` says, and what a run measured.\n\n"
         "Scene files choose an estimator by its keyword in `\"string transmittance\"` of a medium and give "
         "its"
         " parameters in the\nsame entry; the lab takes the same names. A *control* is a bound of the "
         "extinction"
         " by super-voxels: the upper one is\nthe majorant, the lower one the minorant. *Unbiased* means "
         "that the"
         " mean is the transmittance exactly; *consistent*,\nthat it becomes so as the cost of one estimate"
         " grows; *biased*, neither.\n\n";
  printLists(out);
  const DocsTables tables = measureDocs(o, stop);
  if (stop) throw std::runtime_error("stopped: no page is written");
  printTables(out, tables, o);
  printLab(out);
  return out.str();
}

int runDocs(const DocsOptions& options) {
  const std::string& name = options.lab.outfile;
  if (!name.empty() && extensionOf(name) != ".md") {
    throw std::runtime_error(name + ": unknown extension; the page is Markdown: .md");
  }
  if (!name.empty()) checkWritable(name);
  const ThreadLimit limit(options.lab.threads);
  const StopSignal stop;
  const std::string page = docsPage(options, stop);
  writeOutput(options.lab.outfile, [&](std::ostream& out) { out << page; });
  return 0;
}

}  // namespace pbrtmedia
