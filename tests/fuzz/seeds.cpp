// SPDX-License-Identifier: BSD-2-Clause
// fuzz_seeds FOLDER: writes small valid files for the fuzz targets whose formats are binary, into
// FOLDER/<target>. What is there stays.
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "checkpoint_scene.h"
#include "main/checkpoint_file.h"
#include "materials/fourier_sample.h"
#include "media/bounds_cache.h"
#include "media/grid_medium.h"
#include "render/state_stream.h"
#include "support/gzip.h"
#if PBRT_MEDIA_HAS_NANOVDB
#include "fields/nano_vdb_samples.h"
#endif
#if PBRT_MEDIA_FUZZ_VDB
#include "exporters/vdb_samples.h"
#endif

namespace {

using namespace pbrtmedia;
namespace fs = std::filesystem;

fs::path folder(const fs::path& parent, const char* name) {
  fs::create_directories(parent / name);
  return parent / name;
}

void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

void writeBsdfs(const fs::path& to) {
  for (const std::uint32_t channels : {1u, 3u}) {
    const test::FourierSample sample{.channels = channels, .cosines = test::fourierCosines(2)};
    write(to / ("channels" + std::to_string(channels)), sample.bytes());
  }
}

void writeRawGrids(const fs::path& to) {
  std::vector<float> numbers;
  for (int i = 0; i < 27; ++i) numbers.push_back(static_cast<float>(i) / 8);
  std::string bytes(numbers.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  write(to / "ramp", bytes);
  write(to / "ramp.gz", gzipped(bytes));
  write(to / "two.gz", gzipped(bytes) + gzipped(bytes));
  write(to / "empty.gz", gzipped(std::string(1 << 16, '\0')));
}

void writeCheckpoints(const fs::path& to) {
  const std::unique_ptr<Scene> scene = test::checkpointScene();
  const Film film = test::checkpointFilm();
  RenderResult result;
  CheckpointHead head;
  const auto writeAll = [&](const std::string& name) {
    Checkpoint::write(to / name, head, [&](ByteWriter& out) { writeState(out, *scene, film, result); });
  };
  writeAll("empty");
  head.causes = {{"--seed", "0"}, {"the text of the scene", "#1"}};
  head.samplesPerPixel = 4;
  head.samplesDone = 2;
  head.worldsDone = {"{}"};
  head.parts = {{0, 2, {}, 2, "pbrt-media"}};
  result.completedSamplesPerPixel = 2;
  result.dropped.resize(1);
  result.mismatches.resize(1);
  result.violations.resize(1);
  result.learning.resize(1);
  result.learning[0].passes.resize(2);
  writeAll("half");
}

void writeBounds(const fs::path& to) {
  GridMediumParams params;
  params.name = "m";
  params.sigmaA = params.sigmaS = Rgb(1);
  params.grid = {.nx = 2, .ny = 2, .nz = 2, .density = {1, 2, 3, 4, 5, 6, 7, 8}};
  params.bounds.source = BoundsParams::Source::Progressive;
  params.bounds.cells = {{2, 2, 2}};
  const std::unique_ptr<Medium> medium = makeGridMedium(params, Transform());
  BoundsCache cache;
  cache.write(to / "empty");
  cache.keep("scene.pbrt #0", *medium);
  cache.write(to / "one");
  cache.keep("scene.pbrt #1", *medium);
  cache.write(to / "two");
}

#if PBRT_MEDIA_HAS_NANOVDB
void writeNanoVdbs(const fs::path& to) {
  const auto write = [&](const std::string& name, test::NanoVdbStorage storage, test::NanoVdbCodec codec) {
    test::NanoVdbSample sample;
    sample.storage = storage;
    sample.sums = test::NanoVdbSums::None;
    sample.voxels = {{{1, 2, 3}, 0.5}, {{2, 2, 3}, 1.0}, {{200, 2, 3}, 0.25}};
    test::writeNanoVdb(to / name, {sample}, codec);
  };
  write("float", test::NanoVdbStorage::Float, test::NanoVdbCodec::None);
  write("double_zip", test::NanoVdbStorage::Double, test::NanoVdbCodec::Zip);
  write("fp8", test::NanoVdbStorage::Fp8, test::NanoVdbCodec::None);
  write("fpn_zip", test::NanoVdbStorage::FpN, test::NanoVdbCodec::Zip);
  if (test::hasBlosc()) write("float_blosc", test::NanoVdbStorage::Float, test::NanoVdbCodec::Blosc);
}
#endif

#if PBRT_MEDIA_FUZZ_VDB
void writeVdbs(const fs::path& to) {
  test::writeVdb(to / "one_voxel", test::VdbKind::OneVoxel);
  test::writeVdb(to / "tiles", test::VdbKind::TilesOnly);
  test::writeVdb(to / "half", test::VdbKind::Half);
  test::writeVdbOfManyGrids(to / "many");
  test::writeVdbStream(to / "stream", test::VdbKind::OneVoxel);
}
#endif

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  const fs::path to = argv[1];
  writeBsdfs(folder(to, "bsdf"));
  writeRawGrids(folder(to, "rawgrid"));
  writeBounds(folder(to, "bounds"));
  writeCheckpoints(folder(to, "checkpoint"));
#if PBRT_MEDIA_HAS_NANOVDB
  writeNanoVdbs(folder(to, "nanovdb"));
#endif
#if PBRT_MEDIA_FUZZ_VDB
  writeVdbs(folder(to, "vdb"));
#endif
  return 0;
}
