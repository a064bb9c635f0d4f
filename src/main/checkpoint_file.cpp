// SPDX-License-Identifier: BSD-2-Clause
#include "main/checkpoint_file.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "base/diagnostics.h"
#include "base/hash.h"

namespace pbrtmedia {
namespace {

constexpr std::string_view kMagic = "pbrt-media checkpoint ", kVersion = "2\n";
constexpr std::size_t kHashBytes = sizeof(std::uint64_t);

/// As it grows while blocks of ByteWriter::kBlock are written.
std::uint64_t hashByBlocks(std::string_view text) {
  std::uint64_t hash = 1;
  while (!text.empty()) {
    const std::string_view block = text.substr(0, ByteWriter::kBlock);
    hash = hashText(block, hash);
    text.remove_prefix(block.size());
  }
  return hash;
}

void addHead(ByteWriter& out, const CheckpointHead& head) {
  const auto count = [](const auto& list) { return static_cast<std::uint64_t>(list.size()); };
  out.add(count(head.causes));
  for (const auto& [name, value] : head.causes) {
    out.add(name);
    out.add(value);
  }
  out.add(head.samplesPerPixel);
  out.add(head.samplesDone);
  out.add(head.world);
  out.add(count(head.worldsDone));
  for (const std::string& world : head.worldsDone) out.add(world);
  out.add(count(head.parts));
  for (const auto& [first, end, time, threads, version] : head.parts) {
    out.add(static_cast<std::uint64_t>(first));
    out.add(static_cast<std::uint64_t>(end));
    out.add(time.wall);
    out.add(time.cpu);
    out.add(threads);
    out.add(version);
  }
}

CheckpointHead takeHead(ByteReader& in) {
  CheckpointHead head;
  for (std::size_t left = in.count(1); left > 0; --left) {
    std::string name = in.text();
    head.causes.push_back({std::move(name), in.text()});
  }
  head.samplesPerPixel = in.number<std::uint64_t>();
  head.samplesDone = in.number<std::uint64_t>();
  head.world = in.number<std::uint64_t>();
  for (std::size_t left = in.count(1); left > 0; --left) head.worldsDone.push_back(in.text());
  for (std::size_t left = in.count(1); left > 0; --left) {
    RenderPart part;
    part.first = static_cast<std::int64_t>(in.number<std::uint64_t>());
    part.end = static_cast<std::int64_t>(in.number<std::uint64_t>());
    part.time.wall = in.number<double>();
    part.time.cpu = in.number<double>();
    part.threads = in.number<std::uint64_t>();
    part.version = in.text();
    head.parts.push_back(std::move(part));
  }
  return head;
}

}  // namespace

Checkpoint Checkpoint::read(const std::filesystem::path& path) {
  Checkpoint checkpoint(FileBytes::open(path));
  const auto refuse = [&](const std::string& what) {
    SourceLocation at;
    at.file = std::make_shared<const std::string>(path.string());
    throw SceneError(at, "checkpoint: " + what);
  };
  const std::string_view text = checkpoint.file_.text();
  if (text.substr(0, kMagic.size()) != kMagic) refuse("this is no such file");
  if (text.substr(kMagic.size(), kVersion.size()) != kVersion) {
    refuse("version " +
           std::string(text.substr(kMagic.size(), text.find('\n') - kMagic.size())).substr(0, 16) +
           ", expected 2");
  }
  const std::string_view content = text.substr(0, text.size() - std::min(text.size(), kHashBytes));
  if (ByteReader(text.substr(content.size())).left() < kHashBytes ||
      content.size() < kMagic.size() + kVersion.size() ||
      ByteReader(text.substr(content.size())).number<std::uint64_t>() != hashByBlocks(content))
    refuse("the file is truncated or corrupt");
  try {
    ByteReader in(content.substr(kMagic.size() + kVersion.size()));
    checkpoint.head_ = takeHead(in);
    checkpoint.state_ = in.take(in.left());
  } catch (const std::length_error&) {
    refuse("the file is corrupt");
  }
  return checkpoint;
}

std::uint64_t Checkpoint::write(const std::filesystem::path& path, const CheckpointHead& head,
                                const std::function<void(ByteWriter&)>& writeState) {
  std::uint64_t bytes = 0;
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream file(temporary, std::ios::binary);
    const auto put = [&](std::string_view text) {
      if (!file.write(text.data(), static_cast<std::streamsize>(text.size())))
        throw std::runtime_error("cannot write " + temporary.string());
      bytes += text.size();
    };
    std::uint64_t hash = 1;
    ByteWriter out([&](std::string_view block) {
      hash = hashText(block, hash);
      put(block);
    });
    out.addPlain(kMagic);
    out.addPlain(kVersion);
    addHead(out, head);
    writeState(out);
    out.finish();
    ByteWriter end;
    end.add(hash);
    put(end.text());
    file.close();
    if (!file) throw std::runtime_error("cannot write " + temporary.string());
  });
  return bytes;
}

}  // namespace pbrtmedia
