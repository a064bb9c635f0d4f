// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/mlt/primary_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/math.h"

namespace pbrtmedia {
namespace {

double takeNumber(std::span<const double>& at) {
  if (at.empty()) throw std::length_error("the state of a chain ends early");
  const double number = at.front();
  at = at.subspan(1);
  return number;
}

/// Of a standard normal distribution (Box & Muller 1958).
float normal(Rng& rng) {
  const double radius = std::sqrt(2 * rng.exponential());
  return static_cast<float>(radius * std::cos(2 * std::numbers::pi * rng.uniformDouble()));
}

}  // namespace

void PrimarySampler::begin(std::uint64_t randomness) {
  ++step_;
  random_ = Rng(randomness);
  moved_.clear();
  next_ = {};
  stream_ = 0;
  lastLargeBefore_ = lastLarge_;
  seedsBefore_ = seeds_;
}

void PrimarySampler::drawSeeds() {
  for (std::uint64_t& seed : seeds_) seed = random_.next();
}

void PrimarySampler::proposeLarge(std::uint64_t randomness) {
  begin(randomness);
  lastLarge_ = step_;
  drawSeeds();
}

void PrimarySampler::proposeSmall(std::uint64_t randomness, bool redrawsSeeds) {
  begin(randomness);
  if (redrawsSeeds) drawSeeds();
}

void PrimarySampler::reject() {
  for (auto m = moved_.rbegin(); m != moved_.rend(); ++m) coordinates_[m->stream][m->index] = m->before;
  moved_.clear();
  lastLarge_ = lastLargeBefore_;
  seeds_ = seedsBefore_;
  --step_;
}

void PrimarySampler::move(Coordinate& x) {
  if (x.step < lastLarge_) {
    x.value = random_.uniform();
    x.step = lastLarge_;
  }
  if (x.step == step_) return;
  // As many steps as were missed are one that is wider.
  const float missed = static_cast<float>(step_ - x.step);
  x.step = step_;
  const float value = x.value + sigma_ * std::sqrt(missed) * normal(random_);
  x.value = std::clamp(value - std::floor(value), 0.0f, kOneMinusEpsilon);
}

PrimarySampler::Coordinate& PrimarySampler::changing(std::size_t stream, std::size_t index) {
  Coordinate& x = coordinates_[stream][index];
  moved_.push_back({stream, index, x});
  return x;
}

void PrimarySampler::set(Stream stream, std::span<const float> first) {
  const auto number = static_cast<std::size_t>(stream);
  std::vector<Coordinate>& list = coordinates_[number];
  if (list.size() < first.size()) list.resize(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) changing(number, i) = {first[i], step_};
}

float PrimarySampler::get1D() {
  std::vector<Coordinate>& list = coordinates_[stream_];
  const std::size_t index = next_[stream_]++;
  if (index == list.size()) list.emplace_back();
  if (list[index].step != step_) move(changing(stream_, index));
  return list[index].value;
}

Point2f PrimarySampler::get2D() {
  const float x = get1D();
  return {x, get1D()};
}

void PrimarySampler::get2DArray(std::span<Point2f> out) {
  for (Point2f& point : out) point = get2D();
}

std::unique_ptr<Sampler> PrimarySampler::clone() const { return std::make_unique<PrimarySampler>(*this); }

void PrimarySampler::start(Point2i, std::int64_t) { next_ = {}; }

void PrimarySampler::save(std::vector<double>& out) const {
  out.push_back(static_cast<double>(step_));
  out.push_back(static_cast<double>(lastLarge_));
  for (const std::uint64_t seed : seeds_) {
    out.push_back(static_cast<double>(seed >> 32));
    out.push_back(static_cast<double>(seed & 0xffffffffu));
  }
  for (const std::vector<Coordinate>& list : coordinates_) {
    out.push_back(static_cast<double>(list.size()));
    for (const Coordinate& x : list) {
      out.push_back(double{x.value});
      out.push_back(static_cast<double>(x.step));
    }
  }
}

void PrimarySampler::restore(std::span<const double>& at) {
  step_ = static_cast<std::int64_t>(takeNumber(at));
  lastLarge_ = static_cast<std::int64_t>(takeNumber(at));
  for (std::uint64_t& seed : seeds_) {
    const double high = takeNumber(at);
    seed = static_cast<std::uint64_t>(high) << 32 | static_cast<std::uint64_t>(takeNumber(at));
  }
  for (std::vector<Coordinate>& list : coordinates_) {
    const double count = takeNumber(at);
    if (!(count >= 0 && 2 * count <= static_cast<double>(at.size())))
      throw std::length_error("the state of a chain ends early");
    list.resize(static_cast<std::size_t>(count));
    for (Coordinate& x : list) {
      x.value = static_cast<float>(takeNumber(at));
      x.step = static_cast<std::int64_t>(takeNumber(at));
    }
  }
}

}  // namespace pbrtmedia
