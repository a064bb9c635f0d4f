// SPDX-License-Identifier: BSD-2-Clause
#include "media/bounds_cache.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "base/byte_stream.h"
#include "base/diagnostics.h"
#include "base/files.h"
#include "base/hash.h"
#include "fields/learned_bounds.h"

namespace pbrtmedia {
namespace {

constexpr std::string_view kMagic = "pbrt-media bounds ", kVersion = "1\n";

std::array<std::uint64_t, 3> cellsOf(const LearnedBounds& bounds) {
  const auto& n = bounds.inForce().shape().count;
  return {static_cast<std::uint64_t>(n.x), static_cast<std::uint64_t>(n.y), static_cast<std::uint64_t>(n.z)};
}

std::string textOf(const std::array<std::uint64_t, 3>& cells, float epsilon, float slack) {
  std::ostringstream text;
  text << cells[0] << " x " << cells[1] << " x " << cells[2] << " super-voxels, epsilon " << epsilon
       << " and slack " << slack;
  return text.str();
}

}  // namespace

BoundsCache BoundsCache::read(const std::filesystem::path& path) {
  const FileBytes file = FileBytes::open(path);
  const auto refuse = [&](const std::string& what) -> void {
    SourceLocation at;
    at.file = std::make_shared<const std::string>(path.string());
    throw SceneError(at, "bounds cache: " + what);
  };
  const std::string_view text = file.text();
  if (text.substr(0, kMagic.size()) != kMagic) refuse("this is no such file");
  if (text.substr(kMagic.size(), kVersion.size()) != kVersion) {
    refuse("version " +
           std::string(text.substr(kMagic.size(), text.find('\n') - kMagic.size())).substr(0, 16) +
           ", expected 1");
  }
  constexpr std::size_t kHashBytes = sizeof(std::uint64_t);
  BoundsCache cache;
  try {
    if (text.size() < kMagic.size() + kVersion.size() + kHashBytes) throw std::length_error("truncated");
    const std::string_view content = text.substr(0, text.size() - kHashBytes);
    if (ByteReader(text.substr(content.size())).number<std::uint64_t>() != hashBytes(content))
      refuse("the file is truncated or corrupt");
    ByteReader in(content.substr(kMagic.size() + kVersion.size()));
    for (auto left = in.number<std::uint64_t>(); left > 0; --left) {
      std::string scene = in.text(), medium = in.text();
      Entry entry;
      for (std::uint64_t& n : entry.cells) n = in.number<std::uint64_t>();
      entry.epsilon = in.number<float>();
      entry.slack = in.number<float>();
      // Each count alone is below the bytes left, so three of them overflow no 128 bits; divide instead.
      std::uint64_t cells = 1, most = in.left() / (2 * sizeof(float));
      for (const std::uint64_t n : entry.cells) {
        if (n == 0 || n > most / cells) throw std::length_error("more cells than bytes");
        cells *= n;
      }
      entry.bounds.reserve(static_cast<std::size_t>(2 * cells));
      for (std::uint64_t i = 0; i < 2 * cells; ++i) entry.bounds.push_back(in.number<float>());
      cache.entries_[{std::move(scene), std::move(medium)}] = std::move(entry);
    }
    if (in.left() > 0) throw std::length_error("bytes left over");
  } catch (const std::length_error&) {
    refuse("the file is truncated or corrupt");
  }
  return cache;
}

std::string BoundsCache::restore(const std::string& scene, Medium& medium) const {
  const auto found = entries_.find({scene, medium.name()});
  if (found == entries_.end()) return "the cache does not know this medium of scene \"" + scene + '"';
  LearnedBounds& bounds = *medium.learnedBounds();
  const Entry& e = found->second;
  const LearnedBounds::Params& p = bounds.params();
  if (e.cells != cellsOf(bounds) || e.epsilon != p.epsilon || e.slack != p.slack) {
    return "the cache has " + textOf(e.cells, e.epsilon, e.slack) + "; here there are " +
           textOf(cellsOf(bounds), p.epsilon, p.slack);
  }
  return bounds.restore(e.bounds) ? "" : "the cache has bounds that are none";
}

void BoundsCache::keep(const std::string& scene, Medium& medium) {
  const LearnedBounds& bounds = *medium.learnedBounds();
  entries_[{scene, medium.name()}] = {cellsOf(bounds), bounds.params().epsilon, bounds.params().slack,
                                      bounds.save()};
}

void BoundsCache::write(const std::filesystem::path& path) const {
  ByteWriter out;
  out.addPlain(kMagic);
  out.addPlain(kVersion);
  out.add(static_cast<std::uint64_t>(entries_.size()));
  for (const auto& [name, entry] : entries_) {
    out.add(name.first);
    out.add(name.second);
    for (const std::uint64_t n : entry.cells) out.add(n);
    out.add(entry.epsilon);
    out.add(entry.slack);
    for (const float bound : entry.bounds) out.add(bound);
  }
  out.add(hashBytes(out.text()));
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream file(temporary, std::ios::binary);
    file.write(out.text().data(), static_cast<std::streamsize>(out.text().size()));
    file.close();
    if (!file) throw std::runtime_error("cannot write " + temporary.string());
  });
}

}  // namespace pbrtmedia
