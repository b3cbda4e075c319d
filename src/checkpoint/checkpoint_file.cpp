// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint/checkpoint_file.hpp"

#include "checkpoint/history_columns.hpp"
#include "io/state_file.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <memory>
#include <numeric>

namespace trime::checkpoint {
namespace {

using io::MetadataGroup;
using io::StateArray;
using io::ValueKind;
using meshing::RunState;
using sites::SavedSites;
using sites::SavedTiles;

const char* const format_name = "trime_mpi-checkpoint";
constexpr std::int64_t format_version = 1;

// --- hashes ----------------------------------------------------------------------------------------------------------

std::uint64_t hash_of_site(std::int64_t row, const mesh::Site& site, double size) {
  ContentHash hash(static_cast<std::uint64_t>(row));
  hash.add(site.position.x);
  hash.add(site.position.y);
  hash.add(site.lead.x);
  hash.add(site.lead.y);
  hash.add(std::int64_t{site.boundary});
  hash.add(std::int64_t{site.pushes});
  hash.add(size);
  return hash.value();
}

/// The members of a row of the tiles.
struct TileRow {
  std::int64_t x, y, shift, bits, sites, activity, site_hash;
  double drift;
};

std::uint64_t hash_of_tile(std::int64_t row, const TileRow& tile) {
  ContentHash hash(static_cast<std::uint64_t>(row));
  for (const std::int64_t word : {tile.x, tile.y, tile.shift, tile.bits, tile.sites, tile.activity, tile.site_hash})
    hash.add(word);
  hash.add(tile.drift);
  return hash.value();
}

/// Returns the hash of everything except the sites; the tiles contain the hash of these.
std::int64_t hash_of_run(const Title& title, const RunState& state, std::uint64_t hash_of_tiles) {
  ContentHash hash(hash_of_tiles);
  hash.add(title.origin.program);
  hash.add(title.origin.config);
  hash.add(title.number);
  for (const auto& [name, number] : state.numbers) {
    hash.add(name);
    std::visit([&](const auto value) { hash.add(value); }, number);
  }
  add(state.history, hash);
  return static_cast<std::int64_t>(hash.value());
}

// --- writing ---------------------------------------------------------------------------------------------------------

double size_at(const sites::SiteState& sites, LocalIndex i) {
  return sites.sizes().is_uniform() ? 0 : sites.sizes()[i];
}

std::vector<TileRow> tile_rows(const sites::SiteState& sites, std::span<const std::uint64_t> activity,
                               std::int64_t first_site) {
  const mesh::BinnedPoints& points = sites.points();
  std::vector<TileRow> rows(activity.size());
  for (std::size_t t = 0; t < rows.size(); ++t) {
    const LocalIndex number = points.first_tile() + static_cast<LocalIndex>(t);
    const mesh::Tile& tile = sites.grid().tile(number);
    const auto [begin, end] = points.tile_range(number);
    std::uint64_t hash = 0;
    for (LocalIndex i = begin; i < end; ++i)
      hash += hash_of_site(first_site + i, points.site(i), size_at(sites, i));
    rows[t] = {tile.x,
               tile.y,
               tile.shift,
               tile.bits,
               end - begin,
               static_cast<std::int64_t>(activity[t]),
               static_cast<std::int64_t>(hash),
               points.drifts().of(static_cast<LocalIndex>(t))};
  }
  return rows;
}

template <class T>
struct KindOf;
template <>
struct KindOf<double> {
  static constexpr ValueKind value = ValueKind::float64;
};
template <>
struct KindOf<geometry::Vec2> {
  static constexpr ValueKind value = ValueKind::float64;
};
template <>
struct KindOf<std::int64_t> {
  static constexpr ValueKind value = ValueKind::int64;
};
template <>
struct KindOf<std::int32_t> {
  static constexpr ValueKind value = ValueKind::int32;
};
template <>
struct KindOf<std::uint8_t> {
  static constexpr ValueKind value = ValueKind::uint8;
};

/// An array whose row k of this rank is value(k), a T.
template <class T, class Value>
StateArray computed(const char* path, const mesh::Slab& slab, std::size_t rows, const Value& value) {
  const auto fill = [value](std::int64_t first, std::int64_t count, std::byte* out) {
    T* values = reinterpret_cast<T*>(out); // aligned for all of them
    for (std::int64_t k = 0; k < count; ++k)
      values[k] = value(static_cast<std::size_t>(first + k));
  };
  return {path, KindOf<T>::value, std::is_same_v<T, geometry::Vec2> ? 2 : 0, slab, static_cast<std::int64_t>(rows),
          fill};
}

/// One array for each member of the rows of tiles.
void add_tiles(const std::vector<TileRow>& rows, const mesh::Slab& slab, std::vector<StateArray>& arrays) {
  const auto add = [&](const char* path, const auto member) {
    using T = std::remove_cvref_t<decltype(rows[0].*member)>;
    arrays.push_back(computed<T>(path, slab, rows.size(), [&rows, member](std::size_t k) { return rows[k].*member; }));
  };
  add("tiles/x", &TileRow::x);
  add("tiles/y", &TileRow::y);
  add("tiles/shift", &TileRow::shift);
  add("tiles/bits", &TileRow::bits);
  add("tiles/sites", &TileRow::sites);
  add("tiles/activity", &TileRow::activity);
  add("tiles/site_hash", &TileRow::site_hash);
  add("tiles/drift", &TileRow::drift);
}

void add_sites(const sites::SiteState& sites, const mesh::Slab& slab, std::vector<StateArray>& arrays) {
  const mesh::BinnedPoints& points = sites.points();
  const std::size_t owned = static_cast<std::size_t>(points.owned());
  const auto add = [&]<class T>(const char* path, T, const auto& value) {
    arrays.push_back(computed<T>(path, slab, owned,
                                 [value](std::size_t k) { return static_cast<T>(value(static_cast<LocalIndex>(k))); }));
  };
  add("sites/position", geometry::Vec2{}, [&points](LocalIndex i) { return points.position(i); });
  add("sites/boundary", std::int32_t{}, [&points](LocalIndex i) { return points.boundary(i); });
  add("sites/pushes", std::uint8_t{}, [&points](LocalIndex i) { return points.pushes(i); });
  if (points.has_leads())
    add("sites/lead", geometry::Vec2{}, [&points](LocalIndex i) { return points.site(i).lead; });
  if (sites.comm().max(std::int64_t{owned > 0 && !sites.sizes().is_uniform()}) > 0)
    add("sites/size", double{}, [&sites](LocalIndex i) { return sites.sizes()[i]; });
}

// --- reading ---------------------------------------------------------------------------------------------------------

SavedTiles tiles_of(const io::Metadata& metadata, std::vector<std::int64_t>& site_hashes, std::uint64_t& hash) {
  const auto integers = [&](const char* name) -> const std::vector<std::int64_t>& {
    return column<std::int64_t>(metadata, "tiles", name);
  };
  const auto &x = integers("x"), &y = integers("y"), &shift = integers("shift"), &bits = integers("bits"),
             &sites = integers("sites"), &activity = integers("activity");
  site_hashes = integers("site_hash");
  SavedTiles tiles;
  tiles.drifts = column<double>(metadata, "tiles", "drift");
  tiles.counts = sites;
  for (const std::size_t size :
       {y.size(), shift.size(), bits.size(), sites.size(), activity.size(), site_hashes.size(), tiles.drifts.size()})
    if (size != x.size())
      throw FileError(fmt::format("the checkpoint has {} values of its tiles, expected {}", size, x.size()));
  for (std::size_t t = 0; t < x.size(); ++t) {
    hash += hash_of_tile(static_cast<std::int64_t>(t),
                         {x[t], y[t], shift[t], bits[t], sites[t], activity[t], site_hashes[t], tiles.drifts[t]});
    tiles.tiles.push_back({static_cast<std::uint32_t>(x[t]), static_cast<std::uint32_t>(y[t]),
                           static_cast<std::uint8_t>(shift[t]), static_cast<std::uint8_t>(bits[t])});
    tiles.activity.push_back(static_cast<std::uint64_t>(activity[t]));
  }
  return tiles;
}

/// Fetches sites and compares their hashes with those of their tiles.
class Loader {
public:
  Loader(std::string path, std::vector<std::int64_t> counts, std::vector<std::int64_t> hashes)
      : path_(std::move(path)), counts_(std::move(counts)), hashes_(std::move(hashes)) {}

  SavedSites operator()(std::int64_t first, std::int64_t count) const {
    const io::StateFileReader file(path_);
    const std::size_t n = static_cast<std::size_t>(count);
    const bool has_leads = file.has("sites/lead"), has_sizes = file.has("sites/size");
    std::vector<geometry::Vec2> positions(n), leads(has_leads ? n : 0);
    std::vector<std::int32_t> boundary(n);
    std::vector<std::uint8_t> pushes(n);
    SavedSites saved;
    saved.sizes.resize(has_sizes ? n : 0);
    file.read("sites/position", ValueKind::float64, 2, first, count, positions.data());
    file.read("sites/boundary", ValueKind::int32, 0, first, count, boundary.data());
    file.read("sites/pushes", ValueKind::uint8, 0, first, count, pushes.data());
    if (has_leads)
      file.read("sites/lead", ValueKind::float64, 2, first, count, leads.data());
    if (has_sizes)
      file.read("sites/size", ValueKind::float64, 0, first, count, saved.sizes.data());
    saved.sites.resize(n);
    for (std::size_t k = 0; k < n; ++k)
      saved.sites[k] = {positions[k], boundary[k], pushes[k], has_leads ? leads[k] : geometry::Vec2{}};
    check(saved, first, first + count);
    return saved;
  }

private:
  void check(const SavedSites& saved, std::int64_t first, std::int64_t end) const {
    std::int64_t row = 0;
    for (std::size_t t = 0; t < counts_.size() && row < end; row += counts_[t++]) {
      if (row < first)
        continue;
      std::uint64_t hash = 0;
      for (std::int64_t k = row; k < row + counts_[t]; ++k) {
        const std::size_t at = static_cast<std::size_t>(k - first);
        hash += hash_of_site(k, saved.sites[at], saved.sizes.empty() ? 0 : saved.sizes[at]);
      }
      if (hash != static_cast<std::uint64_t>(hashes_[t]))
        throw FileError(fmt::format("{} is damaged: expected the hash {:016x} of the sites of tile {}, found {:016x}",
                                    path_, static_cast<std::uint64_t>(hashes_[t]), t, hash));
    }
  }

  std::string path_;
  std::vector<std::int64_t> counts_, hashes_;
};

/// @throws FileError if it is another format, or another version of this one
void check_format(const std::string& path, const io::Metadata& metadata) {
  const std::string& format = attribute<std::string>(metadata, "format");
  const std::int64_t version = attribute<std::int64_t>(metadata, "format_version");
  if (format != format_name || version != format_version)
    throw FileError(fmt::format("{} has the format '{}', version {}; expected '{}', version {}: only the trime_mpi "
                                "that wrote a checkpoint can read it",
                                path, format, version, format_name, format_version));
}

std::string text_of(const io::Metadata& metadata, const std::string& name) {
  for (const io::Text& text : metadata.texts)
    if (text.name == name)
      return text.text;
  throw FileError(fmt::format("the checkpoint has no text '{}'", name));
}

Found found_in(const std::string& path, const io::Metadata& metadata) {
  check_format(path, metadata);
  Found found;
  found.title = {{text_of(metadata, "program"), text_of(metadata, "config")},
                 attribute<std::int64_t>(metadata, "number")};
  const MetadataGroup* numbers = io::find_group(metadata, "numbers");
  if (!numbers)
    throw FileError("the checkpoint has no group 'numbers'");
  RunState& state = found.run.state;
  for (const io::Attribute& attribute : numbers->attributes)
    if (const auto* integer = std::get_if<std::int64_t>(&attribute.value))
      state.numbers[attribute.name] = *integer;
    else if (const auto* number = std::get_if<double>(&attribute.value))
      state.numbers[attribute.name] = *number;
  state.history = history_of(metadata);
  std::vector<std::int64_t> site_hashes;
  std::uint64_t hash = 0;
  found.run.tiles = tiles_of(metadata, site_hashes, hash);
  const std::int64_t expected = attribute<std::int64_t>(metadata, "content_hash"),
                     is = hash_of_run(found.title, state, hash);
  if (is != expected)
    throw FileError(fmt::format("{} is damaged: expected a state with hash {:016x}, found {:016x}", path,
                                static_cast<std::uint64_t>(expected), static_cast<std::uint64_t>(is)));
  StateFields fields = StateFields::restoring(state.numbers);
  fields.field("largest_drift", found.run.tiles.largest.distance);
  fields.field("largest_drift_in_sides", found.run.tiles.largest.in_sides);
  found.run.load = Loader(path, found.run.tiles.counts, std::move(site_hashes));
  return found;
}

} // namespace

void write_checkpoint(const std::string& path, io::RunFiles* files, const Title& title, const RunState& given,
                      const sites::SiteState& sites, std::span<const std::uint64_t> activity) {
  const comm::Communicator& comm = sites.comm();
  const std::int64_t owned = sites.points().owned();
  const mesh::Slab site_slab{comm.exclusive_scan(owned), comm.sum(owned)};
  const mesh::Slab tile_slab{sites.points().first_tile(), sites.grid().tile_count()};
  RunState state = given;
  mesh::DriftBound largest = sites.points().drifts().largest();
  StateFields fields = StateFields::keeping(state.numbers);
  fields.field("largest_drift", largest.distance);
  fields.field("largest_drift_in_sides", largest.in_sides);
  const std::vector<TileRow> rows = tile_rows(sites, activity, site_slab.first);
  std::uint64_t hash = 0;
  for (std::size_t t = 0; t < rows.size(); ++t)
    hash += hash_of_tile(tile_slab.first + static_cast<std::int64_t>(t), rows[t]);
  hash = static_cast<std::uint64_t>(comm.sum(static_cast<std::int64_t>(hash)));

  io::Metadata metadata;
  metadata.attributes = {{"format", std::string(format_name)},
                         {"format_version", format_version},
                         {"number", title.number},
                         {"content_hash", hash_of_run(title, state, hash)}};
  metadata.texts = {{"program", title.origin.program}, {"config", title.origin.config}};
  MetadataGroup numbers{"numbers", {}, {}};
  for (const auto& [name, number] : state.numbers)
    numbers.attributes.push_back(
        {name, std::visit([](const auto value) -> decltype(io::Attribute::value) { return value; }, number)});
  metadata.groups = {std::move(numbers), columns_of(state.history), {"tiles", {}, {}}, {"sites", {}, {}}};
  std::vector<StateArray> arrays;
  add_tiles(rows, tile_slab, arrays);
  add_sites(sites, site_slab, arrays);
  io::write_state_file(path, files, metadata, arrays, comm);
}

Found read_checkpoint(const std::string& path, const comm::Communicator& comm) {
  return found_in(path, io::read_state_metadata(path, {"history", "tiles"}, comm)); // the same on all ranks
}

std::int64_t checkpoint_number(const std::string& path) {
  try {
    const io::Metadata metadata = io::read_state_metadata(path, {}, comm::Communicator::self());
    check_format(path, metadata);
    return attribute<std::int64_t>(metadata, "number");
  } catch (const FileError&) {
    return -1;
  }
}

} // namespace trime::checkpoint
