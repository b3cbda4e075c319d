// SPDX-License-Identifier: BSD-3-Clause
// Exodus II (Schoof and Yarberry 1994, SAND92-2137, appendix A: its arrays in netCDF): an element block for each
// region, a side set and a node set for each label. Blocks and sets have the number of their region or label as id, and
// its name. elem_num_map holds the numbers of the triangles in the mesh, since elements of one block have consecutive
// ids.
#include "formats/exodus.hpp"

#include "formats/edge_sides.hpp"
#include "formats/rows_by_number.hpp"
#include "trime/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace trime::formats {
namespace {

constexpr float library_version = 5.1F;                      // the first with 64-bit ids
constexpr std::int64_t string_length = 33, line_length = 81; // with a zero at the end

/// The bytes of texts in a table whose rows have equal lengths.
std::string table_of(const std::vector<std::string>& texts, std::int64_t length) {
  std::string bytes;
  for (const std::string& text : texts) {
    bytes += text.substr(0, static_cast<std::size_t>(length - 1));
    bytes.append(static_cast<std::size_t>(length) - std::min(text.size(), static_cast<std::size_t>(length - 1)), '\0');
  }
  return bytes;
}

/// The numbers of names that have a count above 0, from 1, ascending: the blocks or the sets of the file.
template <class Count>
std::vector<std::size_t> numbers_in_use(std::size_t names, const Count& count) {
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < names; ++k)
    if (count(k) > 0)
      used.push_back(k + 1);
  return used;
}

void append_id(std::string& to, std::int64_t id, bool is_long) {
  if (is_long)
    append_big(to, id);
  else
    append_big(to, static_cast<std::int32_t>(id));
}

class ExodusFile {
public:
  ExodusFile(const ExchangeMesh& mesh, NetcdfFormat format)
      : mesh_(mesh), header_(format), has_long_ids_(format == NetcdfFormat::data_64) {}

  FilePlan make(const std::string& path) {
    group();
    describe();
    add_tables();
    add_points();
    add_elements();
    add_side_sets();
    add_point_sets();
    std::vector<io::TextRows> rows{mesh_.once(header_.bytes())};
    rows.insert(rows.end(), rows_.begin(), rows_.end());
    return {path, rows};
  }

private:
  /// Finds blocks and sets and gives numbers to the elements: block by block, in the order of the mesh.
  void group() {
    blocks_ = numbers_in_use(mesh_.names().regions.size(), [&](std::size_t k) { return mesh_.triangles_of_region(k); });
    sets_ = numbers_in_use(mesh_.line_names().size(), [&](std::size_t k) { return mesh_.lines_of(k); });
    const std::int64_t triangles = std::ssize(mesh_.mesh().triangles);
    by_region_ = std::make_shared<const RowsByNumber>(triangles, mesh_.names().regions.size(),
                                                      [&](std::int64_t row) { return mesh_.region(row); });
    elements_.resize(static_cast<std::size_t>(triangles));
    GlobalId before = 0;
    for (const std::size_t region : blocks_) {
      const std::int64_t count = by_region_->count(region);
      const GlobalId first = before + mesh_.comm().exclusive_scan(count) + 1;
      for (std::int64_t k = 0; k < count; ++k)
        elements_[static_cast<std::size_t>(by_region_->row(region, k))] = first + k;
      before += mesh_.triangles_of_region(region - 1);
    }
  }

  std::vector<std::string> block_names() const { return chosen(mesh_.names().regions, blocks_); }
  std::vector<std::string> set_names() const { return chosen(mesh_.line_names(), sets_); }
  static std::vector<std::string> chosen(const std::vector<std::string>& names,
                                         const std::vector<std::size_t>& numbers) {
    std::vector<std::string> found;
    for (const std::size_t number : numbers)
      found.push_back(names[number - 1]);
    return found;
  }

  void describe() {
    std::size_t longest = string_length - 1;
    for (const std::vector<std::string>& names : {block_names(), set_names()})
      for (const std::string& name : names)
        longest = std::max(longest, name.size());
    name_length_ = static_cast<std::int64_t>(longest) + 1;
    header_.attribute({"api_version", library_version});
    header_.attribute({"version", library_version});
    header_.attribute({"floating_point_word_size", std::int32_t{8}});
    header_.attribute({"file_size", std::int32_t{1}}); // arrays of coordinates are separate
    header_.attribute({"maximum_name_length", static_cast<std::int32_t>(longest)});
    constexpr std::int32_t long_maps = 0x0400, long_bulk = 0x1000; // of points and elements, in the file
    header_.attribute({"int64_status", has_long_ids_ ? long_maps | long_bulk : std::int32_t{0}});
    header_.attribute({"title", std::string("trime_mpi mesh")});
    header_.dimension("len_line", line_length);
    name_ = header_.dimension("len_name", name_length_);
    const std::size_t time = header_.dimension("time_step", 0);
    header_.variable({"time_whole", NetcdfType::float64, {time}});
    const std::size_t text = header_.dimension("len_string", string_length), four = header_.dimension("four", 4);
    const std::size_t records = header_.dimension("num_qa_rec", 1);
    add({"qa_records", NetcdfType::character, {records, four, text}},
        {mesh_.once(
            table_of({"trime_mpi", "", "", ""}, string_length))}); // without date: equal meshes give equal files
  }

  /// Adds a variable with its array, which consists of several sets of rows.
  void add(NetcdfVariable variable, const std::vector<io::TextRows>& rows) {
    header_.variable(std::move(variable));
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    if (const std::size_t zeros = header_.padding(); zeros > 0)
      rows_.push_back(mesh_.once(std::string(zeros, '\0')));
  }
  NetcdfType id_type() const { return has_long_ids_ ? NetcdfType::int64 : NetcdfType::int32; }

  /// Blocks or sets: whether they are in use (always 1), their ids and their names. `word` is eb, ss or ns.
  void add_table(const std::string& word, const std::string& items, const std::vector<std::size_t>& numbers,
                 const std::vector<std::string>& names) {
    std::string status, ids;
    for (const std::size_t number : numbers) {
      append_big(status, std::int32_t{1});
      append_big(ids, static_cast<std::int32_t>(number));
    }
    const std::size_t count = header_.dimension(items, std::ssize(numbers));
    add({word + "_status", NetcdfType::int32, {count}}, {mesh_.once(status)});
    add({word + "_prop1", NetcdfType::int32, {count}, {{"name", std::string("ID")}}}, {mesh_.once(ids)});
    add({word + "_names", NetcdfType::character, {count, name_}}, {mesh_.once(table_of(names, name_length_))});
  }
  void add_tables() {
    add_table("eb", "num_el_blk", blocks_, block_names());
    if (sets_.empty())
      return;
    add_table("ss", "num_side_sets", sets_, set_names());
    add_table("ns", "num_node_sets", sets_, set_names());
  }

  void add_points() {
    const std::size_t points = header_.dimension("num_nodes", mesh_.points());
    add({"coordx", NetcdfType::float64, {points}},
        {mesh_.point_rows([](std::int64_t, GlobalId, geometry::Vec2 p, std::string& to) { append_big(to, p.x); })});
    add({"coordy", NetcdfType::float64, {points}},
        {mesh_.point_rows([](std::int64_t, GlobalId, geometry::Vec2 p, std::string& to) { append_big(to, p.y); })});
    const std::size_t axes = header_.dimension("num_dim", 2);
    add({"coor_names", NetcdfType::character, {axes, name_}}, {mesh_.once(table_of({"x", "y"}, name_length_))});
  }

  void add_elements() {
    const mesh::DistributedMesh& part = mesh_.mesh();
    std::vector<io::TextRows> numbers;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const std::size_t count =
          header_.dimension(fmt::format("num_el_in_blk{}", k + 1), mesh_.triangles_of_region(blocks_[k] - 1));
      const std::size_t corners = header_.dimension(fmt::format("num_nod_per_el{}", k + 1), 3);
      add({fmt::format("connect{}", k + 1), id_type(), {count, corners}, {{"elem_type", std::string("TRI3")}}},
          {rows_of_number(by_region_, blocks_[k], [is_long = has_long_ids_, &part](std::int64_t row, std::string& to) {
            for (const GlobalId corner : part.triangle_ids(static_cast<std::size_t>(row)))
              append_id(to, corner + 1, is_long);
          })});
      numbers.push_back(
          rows_of_number(by_region_, blocks_[k], [is_long = has_long_ids_, &part](std::int64_t row, std::string& to) {
            append_id(to, part.triangle_slab.first + row + 1, is_long);
          }));
    }
    const std::size_t elements = header_.dimension("num_elem", mesh_.triangles());
    add({"elem_num_map", id_type(), {elements}}, numbers);
  }

  void add_side_sets() {
    const auto sides = std::make_shared<const std::vector<EdgeSide>>(
        left_sides(mesh_, [this](std::int64_t row) { return elements_[static_cast<std::size_t>(row)]; }));
    const auto by_label = std::make_shared<const RowsByNumber>(mesh_.rank_lines(), mesh_.line_names().size(),
                                                               [&](std::int64_t row) { return mesh_.line_label(row); });
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const std::size_t count = header_.dimension(fmt::format("num_side_ss{}", k + 1), mesh_.lines_of(sets_[k] - 1));
      add({fmt::format("elem_ss{}", k + 1), id_type(), {count}},
          {rows_of_number(by_label, sets_[k], [is_long = has_long_ids_, sides](std::int64_t row, std::string& to) {
            append_id(to, (*sides)[static_cast<std::size_t>(row)].element, is_long);
          })});
      add({fmt::format("side_ss{}", k + 1), id_type(), {count}},
          {rows_of_number(by_label, sets_[k], [is_long = has_long_ids_, sides](std::int64_t row, std::string& to) {
            append_id(to, (*sides)[static_cast<std::size_t>(row)].side, is_long);
          })});
    }
  }

  void add_point_sets() {
    const auto points = std::make_shared<const std::vector<LabelledPoint>>(labelled_points(mesh_));
    const auto by_label =
        std::make_shared<const RowsByNumber>(std::ssize(*points), mesh_.line_names().size(), [&](std::int64_t row) {
          return (*points)[static_cast<std::size_t>(row)].label;
        });
    std::vector<std::int64_t> counts;
    for (const std::size_t label : sets_)
      counts.push_back(by_label->count(label));
    mesh_.comm().sum(counts);
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const std::size_t count = header_.dimension(fmt::format("num_nod_ns{}", k + 1), counts[k]);
      add({fmt::format("node_ns{}", k + 1), id_type(), {count}},
          {rows_of_number(by_label, sets_[k], [is_long = has_long_ids_, points](std::int64_t row, std::string& to) {
            append_id(to, (*points)[static_cast<std::size_t>(row)].point + 1, is_long);
          })});
    }
  }

  const ExchangeMesh& mesh_;
  NetcdfHeader header_;
  bool has_long_ids_;
  std::vector<io::TextRows> rows_;
  std::int64_t name_length_ = 0;    // with a zero at the end
  std::size_t name_ = 0;            // the dimension of this length
  std::vector<std::size_t> blocks_; // regions with triangles, ascending
  std::vector<std::size_t> sets_;   // labels with edges, ascending
  std::vector<GlobalId> elements_;  // number in the file of each triangle of this rank
  std::shared_ptr<const RowsByNumber> by_region_;
};

} // namespace

NetcdfFormat exodus_format(GlobalId points, GlobalId triangles) {
  constexpr GlobalId most_bytes = (GlobalId{1} << 32) - 4; // of an array in CDF-2
  const bool fits = 8 * points <= most_bytes && 12 * triangles <= most_bytes;
  return fits ? NetcdfFormat::offset_64 : NetcdfFormat::data_64;
}

FilePlan exodus_file(const ExchangeMesh& mesh, const std::string& path, NetcdfFormat format) {
  return ExodusFile(mesh, format).make(path);
}

std::vector<FilePlan> plan_exodus(const ExchangeMesh& mesh, const std::string& path) {
  if (mesh.triangles() == 0) // all ranks find the same
    throw FileError(fmt::format("the mesh has no triangle; expected at least one, since {} cannot hold arrays without "
                                "elements",
                                path));
  return {exodus_file(mesh, path, exodus_format(mesh.points(), mesh.triangles()))};
}

} // namespace trime::formats
