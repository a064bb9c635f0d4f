// SPDX-License-Identifier: BSD-2-Clause
#include "materials/subsurface_exit.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "materials/cosine_sampling.h"
#include "materials/fresnel.h"

namespace pbrtmedia {

namespace {
double withinFit(double eta) { return std::min(eta, double{kLargestMomentIndex}); }
}  // namespace

// Coefficients: scene-language reference 15.2.

double fresnelMoment1(double eta) {
  eta = withinFit(eta);
  if (eta <= 1) {
    return 0.45966 +
           eta * (-1.73965 + eta * (3.37668 + eta * (-3.904945 + eta * (2.49277 + eta * -0.68441))));
  }
  return -4.61686 + eta * (11.1136 + eta * (-10.4646 + eta * (5.11455 + eta * (-1.27198 + eta * 0.12746))));
}

double fresnelMoment2(double eta) {
  eta = withinFit(eta);
  if (eta <= 1) {
    return 0.27614 + eta * (-0.87350 + eta * (1.12077 + eta * (-0.65095 + eta * (0.07883 + eta * 0.04860))));
  }
  const double inverse = 1 / eta;
  return -547.033 + inverse * (458.843 + inverse * (-218.725 + inverse * 45.3087)) +
         eta * (404.557 + eta * (-189.519 + eta * (54.9327 + eta * (-9.00603 + eta * 0.63942))));
}

SubsurfaceExit::SubsurfaceExit(float eta, bool isRadiance)
    : eta_(eta),
      scale_((isRadiance ? sqr(eta) : 1.0f) * kInvPi /
             static_cast<float>(1 - 2 * fresnelMoment1(1 / static_cast<double>(eta)))) {}

Rgb SubsurfaceExit::f(Vector3f, Vector3f wi) const {
  return Rgb(scale_ * (1 - fresnelDielectric(std::abs(wi.z), 1, eta_)));
}

float SubsurfaceExit::pdf(Vector3f wo, Vector3f wi) const { return cosinePdf(wo, wi); }

LobeSample SubsurfaceExit::sample(Vector3f wo, Point2f u) const { return sampleByCosine(*this, wo, u); }

}  // namespace pbrtmedia
