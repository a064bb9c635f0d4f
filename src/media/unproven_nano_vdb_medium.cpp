// SPDX-License-Identifier: BSD-2-Clause
#include "media/unproven_medium.h"
#include "media/unproven_medium_body.h"

namespace pbrtmedia {

std::unique_ptr<Medium> makeUnprovenMedium(const FieldMediumParams& params, std::string_view typeName,
                                           NanoVdbField field) {
  return unprovenMedium(params, typeName, std::move(field));
}

}  // namespace pbrtmedia
