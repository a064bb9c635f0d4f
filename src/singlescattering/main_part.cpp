// SPDX-License-Identifier: BSD-2-Clause
#include "singlescattering/main_part.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace pbrtmedia {

MainPart::MainPart(std::span<const Explorer> explorers, double tMin, double tMax) {
  CHECK(!explorers.empty() && tMin < tMax);
  explorers = explorers.first(std::min(explorers.size(), kMost));
  add(tMin, explorers.front().extinction);
  for (const Explorer& e : explorers) {
    add(e.t, e.extinction);
    largestDifference_ = std::max(largestDifference_, e.difference);
  }
  add(tMax, explorers.back().extinction);
}

void MainPart::add(double t, Rgb extinction) {
  Node node{.t = t};
  for (std::size_t c = 0; c < 3; ++c) {
    node.value.extinction[c] = double{extinction[c]};
    if (count_ == 0) continue;
    const Node& last = nodes_[count_ - 1];
    node.value.depth[c] =
        last.value.depth[c] + (t - last.t) * (last.value.extinction[c] + node.value.extinction[c]) / 2;
  }
  nodes_[count_++] = node;
}

MainPart::Value MainPart::at(double t) const {
  const auto* const end = nodes_.data() + count_;
  const Node* const b = std::min(
      std::upper_bound(nodes_.data() + 1, end, t, [](double x, const Node& n) { return x < n.t; }), end - 1);
  const Node* const a = b - 1;
  const double span = b->t - a->t, share = span > 0 ? std::clamp((t - a->t) / span, 0.0, 1.0) : 0;
  Value value;
  for (std::size_t c = 0; c < 3; ++c) {
    const double from = a->value.extinction[c], here = from + share * (b->value.extinction[c] - from);
    value.extinction[c] = here;
    value.depth[c] = a->value.depth[c] + share * span * (from + here) / 2;
  }
  return value;
}

double MainPart::invert(std::size_t channel, double depth) const {
  const auto* const end = nodes_.data() + count_;
  const Node* const b =
      std::min(std::upper_bound(nodes_.data() + 1, end, depth,
                                [&](double x, const Node& n) { return x < n.value.depth[channel]; }),
               end - 1);
  const Node* const a = b - 1;
  const double span = b->t - a->t, rest = depth - a->value.depth[channel];
  if (!(rest > 0)) return a->t;
  const double from = a->value.extinction[channel], slope = (b->value.extinction[channel] - from) / span;
  // The positive root of from x + slope x²/2 = rest, in the form that does not cancel.
  const double x = 2 * rest / (from + std::sqrt(std::max(0.0, from * from + 2 * slope * rest)));
  return x < span ? a->t + x : b->t;
}

}  // namespace pbrtmedia
