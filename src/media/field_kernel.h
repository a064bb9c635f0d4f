// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "fields/field_line.h"
#include "freeflight/flight_list.h"
#include "media/density_kernel.h"
#include "transmittance/estimate_on.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia {

/// The kernel of one kind of field. Holds every estimator and free-flight sampler for one and three channels,
/// so each kind is compiled in one source file.
template <class Field>
class FieldKernel final : public DensityKernel {
 public:
  FieldKernel(Field field, FieldBounds bounds)
      : DensityKernel(std::move(bounds), field.localFromWorld(), field.worldFromLocal()),
        field_(std::move(field)) {}

  Estimate<1> estimate(const ClippedLine& line, const Channels<1>& sigmaT, const AnyEstimator& estimator,
                       SampleStream& stream) const override {
    return estimateBy(line, sigmaT, estimator, stream);
  }
  Estimate<3> estimate(const ClippedLine& line, const Channels<3>& sigmaT, const AnyEstimator& estimator,
                       SampleStream& stream) const override {
    return estimateBy(line, sigmaT, estimator, stream);
  }
  PairedEstimate<1> paired(const ClippedLine& line, const Channels<1>& sigmaT, const AnyEstimator& estimator,
                           SampleStream& stream) const override {
    return pairedBy(line, sigmaT, estimator, stream);
  }
  PairedEstimate<3> paired(const ClippedLine& line, const Channels<3>& sigmaT, const AnyEstimator& estimator,
                           SampleStream& stream) const override {
    return pairedBy(line, sigmaT, estimator, stream);
  }
  FlightSample<1> fly(const ClippedLine& line, const FlightQuery<1>& query, const AnyFlight& flights,
                      SampleStream& stream) const override {
    return flyBy(line, query, flights, stream);
  }
  FlightSample<3> fly(const ClippedLine& line, const FlightQuery<3>& query, const AnyFlight& flights,
                      SampleStream& stream) const override {
    return flyBy(line, query, flights, stream);
  }

  float density(const ClippedLine& line, double s) const override { return on(line).density(s); }
  float density(Vec3d local) const override {
    const float density = field_.density(local);
    const LearnedBounds* const learned = bounds().learned();
    return learned != nullptr ? learned->bounded(local, density) : density;
  }
  float uncutDensity(Vec3d local) const override { return field_.density(local); }

  void walk(const ClippedLine& line, const AnyVisit& visit) const override { on(line).walk(visit); }
  bool hasPieces() const override { return PiecewiseCubicField<Field> && bounds().areProven(); }
  int countPieces(const ClippedLine& line, int most) const override {
    int pieces = 0;
    if constexpr (PiecewiseCubicField<Field>) {
      on(line).walkPieces([&](double, double) { return ++pieces < most; });
    }
    return pieces;
  }
  bool hasBatches() const override { return BatchedField<Field>; }

  std::string describe() const override { return field_.describe(); }
  std::string complaint() const override {
    if constexpr (requires { field_.complaint(); }) {
      return field_.complaint();
    } else {
      return {};
    }
  }
  std::size_t bytes() const override { return field_.bytes() + bounds().bytes(); }

 private:
  FieldLine<Field> on(const ClippedLine& line) const { return {field_, bounds(), line}; }

  template <std::size_t N>
  Estimate<N> estimateBy(const ClippedLine& line, const Channels<N>& sigmaT, const AnyEstimator& any,
                         SampleStream& stream) const {
    return visitEstimator(
        [&, on = on(line)](const auto& estimator) { return estimateOn(estimator, on, sigmaT, stream); }, any);
  }
  template <std::size_t N>
  PairedEstimate<N> pairedBy(const ClippedLine& line, const Channels<N>& sigmaT, const AnyEstimator& any,
                             SampleStream& stream) const {
    return visitEstimator(
        [&, on = on(line)](const auto& estimator) { return pairedOn(estimator, on, sigmaT, stream); }, any);
  }
  template <std::size_t N>
  FlightSample<N> flyBy(const ClippedLine& line, const FlightQuery<N>& query, const AnyFlight& any,
                        SampleStream& stream) const {
    return visitFlight([&, on = on(line)](const auto& flights) { return flyOn(flights, on, query, stream); },
                       any);
  }

  Field field_;
};

}  // namespace pbrtmedia
