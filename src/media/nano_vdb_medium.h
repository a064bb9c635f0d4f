// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "base/transform.h"
#include "fields/nano_vdb_field.h"
#include "media/field_medium_params.h"
#include "media/medium.h"

namespace pbrtmedia {

/// A medium whose density is a grid of an .nvdb file. Throws SceneError: at the file for a bad file, with
/// unknown location for bad parameters and for a grid that is not there.
struct NanoVdbMediumParams : FieldMediumParams {
  NanoVdbField::Params field;
};
std::unique_ptr<Medium> makeNanoVdbMedium(const NanoVdbMediumParams& params,
                                          const Transform& worldFromMedium);

}  // namespace pbrtmedia
