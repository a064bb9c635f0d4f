// SPDX-License-Identifier: BSD-2-Clause
#include "fields/nano_vdb_samples.h"

#define NANOVDB_USE_ZIP
#if PBRT_MEDIA_HAS_BLOSC
#define NANOVDB_USE_BLOSC
#endif
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/SampleFromVoxels.h>

namespace pbrtmedia::test {
namespace {

nanovdb::Map mapOf(const Transform& worldFromIndex) {
  // Rows of NanoVDB's arguments are columns of ours.
  double forward[4][4], backward[4][4];
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      forward[i][j] = worldFromIndex.matrix().m[j][i];
      backward[i][j] = worldFromIndex.inverseMatrix().m[j][i];
    }
  }
  nanovdb::Map map;
  map.set(forward, backward, 1.0);
  return map;
}

template <class Value, class Build>
nanovdb::GridHandle<> build(const NanoVdbSample& sample) {
  nanovdb::GridBuilder<Value, Build> builder(static_cast<Value>(sample.background));
  builder.setGridClass(sample.isLevelSet ? nanovdb::GridClass::LevelSet : nanovdb::GridClass::FogVolume);
  builder.setStats(nanovdb::StatsMode::All);
  builder.setChecksum(sample.sums == NanoVdbSums::None      ? nanovdb::ChecksumMode::Disable
                      : sample.sums == NanoVdbSums::Partial ? nanovdb::ChecksumMode::Partial
                                                            : nanovdb::ChecksumMode::Full);
  if (!sample.voxels.empty()) {
    auto accessor = builder.getAccessor();
    for (const auto& [at, value] : sample.voxels) {
      accessor.setValue(nanovdb::Coord(at[0], at[1], at[2]), static_cast<Value>(value));
    }
    return builder.template getHandle<>(mapOf(sample.worldFromIndex), sample.name);
  }
  builder(
      [&](const nanovdb::Coord& at) {
        return static_cast<Value>(sample.valueAt({at[0], at[1], at[2]}));
      },
      nanovdb::CoordBBox({sample.min[0], sample.min[1], sample.min[2]},
                         {sample.max[0], sample.max[1], sample.max[2]}));
  return builder.template getHandle<>(mapOf(sample.worldFromIndex), sample.name);
}

nanovdb::GridHandle<> build(const NanoVdbSample& sample) {
  switch (sample.storage) {
    case NanoVdbStorage::Double:
      return build<double, double>(sample);
    case NanoVdbStorage::Fp4:
      return build<float, nanovdb::Fp4>(sample);
    case NanoVdbStorage::Fp8:
      return build<float, nanovdb::Fp8>(sample);
    case NanoVdbStorage::Fp16:
      return build<float, nanovdb::Fp16>(sample);
    case NanoVdbStorage::FpN:
      return build<float, nanovdb::FpN>(sample);
    case NanoVdbStorage::Float:
      break;
  }
  return build<float, float>(sample);
}

}  // namespace

void writeNanoVdb(const std::filesystem::path& file, const std::vector<NanoVdbSample>& grids,
                  NanoVdbCodec codec) {
  std::vector<nanovdb::GridHandle<>> handles;
  for (const NanoVdbSample& grid : grids) handles.push_back(build(grid));
  nanovdb::io::writeGrids(file.string(), handles,
                          codec == NanoVdbCodec::Zip     ? nanovdb::io::Codec::ZIP
                          : codec == NanoVdbCodec::Blosc ? nanovdb::io::Codec::BLOSC
                                                         : nanovdb::io::Codec::NONE);
}

void writeNanoVdbWithVectors(const std::filesystem::path& file) {
  nanovdb::GridBuilder<nanovdb::Vec3f> builder(nanovdb::Vec3f(0.0f));
  builder.getAccessor().setValue(nanovdb::Coord(1, 2, 3), nanovdb::Vec3f(1.0f));
  std::vector<nanovdb::GridHandle<>> handles;
  handles.push_back(builder.getHandle<>(1.0, nanovdb::Vec3d(0.0), "velocity"));
  handles.push_back(build<float, float>(NanoVdbSample{}));
  nanovdb::io::writeGrids(file.string(), handles);
}

namespace {

template <class Build>
std::vector<double> sampledAs(const nanovdb::NanoGrid<Build>& grid, const std::vector<Vec3d>& world) {
  const auto accessor = grid.getAccessor();
  const auto sampler = nanovdb::createSampler<1>(accessor);
  std::vector<double> values;
  for (const Vec3d& p : world) {
    values.push_back(static_cast<double>(sampler(grid.worldToIndex(nanovdb::Vec3d(p.x, p.y, p.z)))));
  }
  return values;
}

}  // namespace

std::vector<double> sampledByNanoVdb(const std::filesystem::path& file, unsigned grid,
                                     const std::vector<Vec3d>& world) {
  const auto handle = nanovdb::io::readGrid(file.string(), grid);
  if (const auto* g = handle.grid<float>()) return sampledAs(*g, world);
  if (const auto* g = handle.grid<double>()) return sampledAs(*g, world);
  if (const auto* g = handle.grid<nanovdb::Fp4>()) return sampledAs(*g, world);
  if (const auto* g = handle.grid<nanovdb::Fp8>()) return sampledAs(*g, world);
  if (const auto* g = handle.grid<nanovdb::Fp16>()) return sampledAs(*g, world);
  if (const auto* g = handle.grid<nanovdb::FpN>()) return sampledAs(*g, world);
  return {};
}

bool hasBlosc() {
#if PBRT_MEDIA_HAS_BLOSC
  return true;
#else
  return false;
#endif
}

}  // namespace pbrtmedia::test
