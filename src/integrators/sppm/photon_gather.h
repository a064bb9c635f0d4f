// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

#include "integrators/path/indirect_light.h"
#include "integrators/sppm/photon.h"
#include "integrators/sppm/photon_kernel.h"
#include "integrators/sppm/photon_map.h"

namespace pbrtmedia {

/// The photons of an iteration.
struct PhotonMaps {
  PhotonMap<SurfacePhoton> onSurfaces;
  PhotonMap<MediumPhoton> inMedia;
  double paths = 0;  ///< from the lights that they are of
};

/// Indirect light of a camera sample, by the density of photons around its vertices: within a disc on
/// surfaces, within a ball in media, weighed by a kernel.
///
/// The mean is that of the light within the radius, so what is small or beyond an edge is blurred; it is
/// exact in the limit of small radii. Where sigma_s varies, a photon counts by the mean of that at both
/// points, which bounds the weights of pairs in thin smoke.
class PhotonGather final : public IndirectLight {
 public:
  struct Kernels {
    DiscKernel onSurfaces;
    BallKernel inMedia;
  };
  /// Counts of photons.
  struct Found {
    std::uint64_t onSurfaces = 0, inMedia = 0;
  };
  /// `mostVertices`: scatterings of camera and light path together.
  PhotonGather(const PhotonMaps& maps, int mostVertices) : maps_(maps), mostVertices_(mostVertices) {}
  /// To be called before each sample.
  void begin(const Kernels& kernels) {
    kernels_ = kernels;
    found_ = {};
  }
  /// By the sample so far, with those that send nothing toward the camera.
  const Found& found() const { return found_; }

  Rgb scatteredOnSurface(const SurfaceInteraction& si, const Bsdf& bsdf, int vertex) override;
  Rgb scatteredInMedium(Point3f p, Vector3f wo, const PhaseFunction& phase, Rgb sigmaS, int vertex) override;

 private:
  bool joins(const Photon& photon, int vertex) const { return photon.scatterings + vertex <= mostVertices_; }

  const PhotonMaps& maps_;
  int mostVertices_;
  Kernels kernels_{{KernelShape::Uniform, 0}, {KernelShape::Uniform, 0}};
  Found found_;
};

}  // namespace pbrtmedia
