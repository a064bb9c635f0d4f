// SPDX-License-Identifier: BSD-2-Clause
#include "render/integrator.h"

#include <glog/logging.h>

#include "render/render_result.h"

namespace pbrtmedia {

RenderResult Integrator::renderSum(std::span<const ImageTerm>, std::optional<std::int64_t>, const Sampler&,
                                   Film&, const RenderOptions&) const {
  LOG(FATAL) << typeName() << " renders no sums";
}

}  // namespace pbrtmedia
