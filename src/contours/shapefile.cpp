// SPDX-License-Identifier: BSD-3-Clause
#include "contours/contour_text.hpp"

#include "contours/feature_rings.hpp"
#include "contours/map_features.hpp"
#include "core/read_file.hpp"
#include "trime/core/error.hpp"

#include <shapefil.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

namespace trime::contours {
namespace {

/// Keeps the message that libshp would print.
std::string& said() {
  static std::string text; // its error hook has no other way to pass it on; serial
  return text;
}

struct Close {
  void operator()(SHPInfo* file) const { SHPClose(file); }
  void operator()(SHPObject* shape) const { SHPDestroyObject(shape); }
  void operator()(DBFInfo* table) const { DBFClose(table); }
};
using File = std::unique_ptr<SHPInfo, Close>;
using Table = std::unique_ptr<DBFInfo, Close>;
using Record = std::unique_ptr<SHPObject, Close>;

/// Returns the file next to `path` with another ending, in upper or lower case, as it exists.
std::string beside(const std::string& path, const char* ending, const char* upper_ending) {
  const std::string stem = path.substr(0, path.size() - 4);
  return std::filesystem::exists(stem + ending) ? stem + ending : stem + upper_ending;
}

SAHooks hooks_of_libshp() {
  SAHooks hooks;
  SASetupDefaultHooks(&hooks);
  hooks.Error = [](const char* message) { said() += (said().empty() ? "" : "; ") + std::string(message); };
  said().clear();
  return hooks;
}

/// libshp believes the length in the head of NAME.shx, and allocates memory for that number of records.
void check_index(const std::string& path) {
  constexpr std::size_t head = 100, row = 8, length_at = 24; // [bytes]
  const std::string bytes = read_file(path);
  std::size_t told = 0; // in words of 16 bits, the first byte the highest
  for (std::size_t k = length_at; k < length_at + 4 && k < bytes.size(); ++k)
    told = told << 8 | static_cast<unsigned char>(bytes[k]);
  if (bytes.size() < head || 2 * told != bytes.size() || (bytes.size() - head) % row != 0)
    throw FileError(fmt::format("{} is damaged or cut off: expected {} bytes, a header of {} and {} for each record, "
                                "as its header says; found {}",
                                path, 2 * told, head, row, bytes.size()));
}

/// @param bytes of the file
File open(const std::string& path, std::string_view bytes) {
  SAHooks hooks = hooks_of_libshp();
  if (!std::filesystem::exists(beside(path, ".shx", ".SHX")))
    throw FileError(fmt::format("cannot open {}: a shapefile is at least NAME.shp and NAME.shx, expected both in one "
                                "directory; copy all files of the set, or write it again with ogr2ogr",
                                beside(path, ".shx", ".shx")));
  if (!bytes.starts_with(std::string_view("\0\0\x27\x0a", 4))) // libshp reads anything as an empty shapefile
    throw FileError(fmt::format("{} is not a shapefile: expected the file code 9994 in its first 4 bytes", path));
  check_index(beside(path, ".shx", ".SHX"));
  File file(SHPOpenLL(path.c_str(), "rb", &hooks));
  if (!file)
    throw FileError(fmt::format("{} is not a shapefile, or it is damaged: expected one that libshp opens, found: {}",
                                path, said().empty() ? "no header of a shapefile" : trimmed(said())));
  return file;
}

/// Does each first byte of a character say how many follow?
bool is_utf8(std::string_view text) {
  for (std::size_t k = 0; k < text.size();) {
    const auto byte = static_cast<unsigned char>(text[k++]);
    int follow = byte < 0x80 ? 0 : byte >= 0xC2 && byte < 0xE0 ? 1 : byte >= 0xE0 && byte < 0xF0 ? 2 : 3;
    if (byte >= 0xF5 || (byte >= 0x80 && byte < 0xC2))
      return false;
    for (; follow > 0; --follow)
      if (k >= text.size() || (static_cast<unsigned char>(text[k++]) & 0xC0) != 0x80)
        return false;
  }
  return true;
}

/// A text that is not UTF-8 is Latin-1, as in old shapefiles.
std::string as_utf8(const std::string& text) {
  if (is_utf8(text))
    return text;
  std::string wide;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      wide += c;
    } else {
      wide += static_cast<char>(0xC0 | byte >> 6);
      wide += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return wide;
}

/// NAME.dbf, and in it the fields of the attribute that names the boundary and of the one that names the feature in
/// messages.
class Attributes {
public:
  Attributes(const std::string& path, const std::string& attribute, FeatureRings& rings) {
    const bool exists = std::filesystem::exists(beside(path, ".dbf", ".DBF"));
    if (attribute.empty() && !exists)
      return;
    if (!exists)
      throw FileError(
          fmt::format("cannot open {}, which has the attributes of {}: expected both in one directory; copy "
                      "all files of the set",
                      beside(path, ".dbf", ".dbf"), path));
    const std::string file = beside(path, ".dbf", ".DBF");
    SAHooks hooks = hooks_of_libshp();
    table_.reset(DBFOpenLL(file.c_str(), "rb", &hooks));
    if (!table_ && attribute.empty())
      return;
    if (!table_)
      throw FileError(fmt::format("{} is damaged: expected a table of dBASE that libshp opens, found: {}", file,
                                  said().empty() ? "another file" : trimmed(said())));
    if (!attribute.empty())
      field_ = DBFGetFieldIndex(table_.get(), attribute.c_str()); // in any case of letters
    int best = 0;
    for (int k = 0; k < DBFGetFieldCount(table_.get()); ++k) {
      std::array<char, XBASE_FLDNAME_LEN_READ + 1> name{};
      DBFGetFieldInfo(table_.get(), k, name.data(), nullptr, nullptr);
      rings.has_attribute(k == field_ ? attribute : as_utf8(name.data()));
      if (const int rank = std::max(telling_rank(name.data()), k == field_ ? chosen_rank : 0); rank > best) {
        best = rank;
        name_field_ = k;
      }
    }
  }

  std::optional<std::string> of(int record) const { return value(record, field_); }
  std::string name_of(int record) const { return value(record, name_field_).value_or(std::string()); }

private:
  std::optional<std::string> value(int record, int field) const {
    if (field < 0 || record >= DBFGetRecordCount(table_.get()) || DBFIsAttributeNULL(table_.get(), record, field) != 0)
      return {};
    const char* text = DBFReadStringAttribute(table_.get(), record, field);
    return text == nullptr ? std::optional<std::string>() : as_utf8(text);
  }

  Table table_;
  int field_ = -1, name_field_ = -1;
};

class ShapefileReader {
  static constexpr int no_line = 0; // messages name the feature

public:
  ShapefileReader(const std::string& path, std::string_view bytes, const std::string& attribute, FeatureRings::Use use)
      : path_(path), file_(open(path, bytes)), rings_(contour_, attribute, use), attributes_(path, attribute, rings_) {
    contour_.source = path;
  }

  Contour read(Faults faults) {
    int records = 0, type = 0;
    SHPGetInfo(file_.get(), &records, &type, nullptr, nullptr);
    for (int k = 0; k < records; ++k) {
      const Record record(SHPReadObject(file_.get(), k));
      if (!record)
        throw FileError(fmt::format("{}:{}: the record is damaged: expected {} records, found {} that can be read: {}",
                                    path_, k + 1, records, k, said().empty() ? "the file is too short" : said()));
      add(*record, k + 1);
      rings_.end_feature(attributes_.of(k), {k + 1, attributes_.name_of(k)});
    }
    rings_.finish("a shapefile with polygons", faults);
    return std::move(contour_);
  }

private:
  void add(const SHPObject& record, int number) {
    const int type = record.nSHPType;
    const bool is_line = type == SHPT_ARC || type == SHPT_ARCZ || type == SHPT_ARCM,
               is_polygon = type == SHPT_POLYGON || type == SHPT_POLYGONZ || type == SHPT_POLYGONM;
    if (type == SHPT_NULL)
      return;
    if (!is_line && !is_polygon) {
      rings_.skip(SHPTypeName(type), number);
      return;
    }
    for (int part = 0; part < record.nParts; ++part) {
      const int first = record.panPartStart[part],
                end = part + 1 < record.nParts ? record.panPartStart[part + 1] : record.nVertices;
      if (first < 0 || end > record.nVertices || first >= end)
        throw FileError(fmt::format("{}:{}: part {} of the record is damaged: expected vertices within 0 to {}, found "
                                    "{} to {}",
                                    path_, number, part + 1, record.nVertices, first, end));
      std::vector<FilePoint> vertices;
      for (int k = first; k < end; ++k)
        vertices.push_back({{record.padfX[k], record.padfY[k]}, no_line});
      rings_.add(is_line ? FeatureRings::Kind::line : FeatureRings::Kind::polygon, std::move(vertices), part > 0);
    }
  }

  const std::string& path_;
  File file_;
  Contour contour_;
  FeatureRings rings_;
  Attributes attributes_;
};

} // namespace

namespace {

Contour read(const std::string& path, const std::string& hint, const std::string& attribute, FeatureRings::Use use,
             Faults faults) {
  const std::string bytes = read_file(path, hint); // the reason of the system if it cannot be opened
  Contour contour = ShapefileReader(path, bytes, attribute, use).read(faults);
  if (const std::string prj = beside(path, ".prj", ".PRJ"); std::filesystem::exists(prj))
    contour.crs = std::string(trimmed(read_file(prj)));
  return contour;
}

} // namespace

Contour read_shapefile(const std::string& path, const std::string& hint, const std::string& attribute, Faults faults) {
  return read(path, hint, attribute, FeatureRings::Use::rings, faults);
}

Contour read_shapefile_lines(const std::string& path, const std::string& hint, const std::string& attribute) {
  return read(path, hint, attribute, FeatureRings::Use::curves, Faults::refuse);
}

} // namespace trime::contours
