// SPDX-License-Identifier: BSD-3-Clause
#include "app/checkpoint_names.hpp"

#include <charconv>
#include <filesystem>
#include <set>

namespace trime::app {
namespace {

constexpr const char *before_slot = ".checkpoint-", *behind_slot = ".h5";

} // namespace

std::string checkpoint_path(const io::MeshFileOptions& output, int slot) {
  return output.path(before_slot + std::to_string(slot) + behind_slot);
}

int checkpoint_slot(const std::string& file, const std::string& name) {
  const std::string start = name + before_slot;
  if (!file.starts_with(start))
    return 0;
  int slot = 0;
  std::from_chars(file.data() + start.size(), file.data() + file.size(), slot);
  const bool is_one = slot >= 1 && slot <= most_checkpoints && file == start + std::to_string(slot) + behind_slot;
  return is_one ? slot : 0;
}

std::vector<std::string> checkpoint_files(const io::MeshFileOptions& output) {
  namespace fs = std::filesystem;
  std::set<int> slots;
  std::error_code error;
  for (fs::directory_iterator at(output.directory, error), end; !error && at != end; at.increment(error))
    if (const int slot = checkpoint_slot(at->path().filename().string(), output.name); slot > 0)
      slots.insert(slot);
  std::vector<std::string> files;
  for (const int slot : slots)
    files.push_back(checkpoint_path(output, slot));
  return files;
}

} // namespace trime::app
