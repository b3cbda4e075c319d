// SPDX-License-Identifier: BSD-3-Clause
#include "shape/shapefile.hpp"

#include "contour_text.hpp"
#include "core/read_file.hpp"
#include "shape/ring_builder.hpp"
#include "trime/core/error.hpp"

#include <shapefil.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string_view>

namespace trime::shape {
namespace {

using geometry::Vec2;

/// What libshp would print.
std::string& said() {
  static std::string text; // its error hook has no other way to pass it on; serial
  return text;
}

struct Close {
  void operator()(SHPInfo* file) const { SHPClose(file); }
  void operator()(SHPObject* shape) const { SHPDestroyObject(shape); }
};
using File = std::unique_ptr<SHPInfo, Close>;
using Record = std::unique_ptr<SHPObject, Close>;

/// A file beside `path` with another ending, in the case of letters that is there.
std::string beside(const std::string& path, const char* ending, const char* upper_ending) {
  const std::string stem = path.substr(0, path.size() - 4);
  return std::filesystem::exists(stem + ending) ? stem + ending : stem + upper_ending;
}

/// @param bytes of the file
File open(const std::string& path, std::string_view bytes) {
  SAHooks hooks;
  SASetupDefaultHooks(&hooks);
  hooks.Error = [](const char* message) { said() += (said().empty() ? "" : "; ") + std::string(message); };
  said().clear();
  if (!std::filesystem::exists(beside(path, ".shx", ".SHX")))
    throw FileError(fmt::format("cannot open {}: a shapefile is at least NAME.shp and NAME.shx, expected both in one "
                                "directory; copy all files of the set, or make it anew by ogr2ogr",
                                beside(path, ".shx", ".shx")));
  if (!bytes.starts_with(std::string_view("\0\0\x27\x0a", 4))) // libshp reads anything as an empty shapefile
    throw FileError(fmt::format("{} is no shapefile: expected the file code 9994 in its first 4 bytes", path));
  File file(SHPOpenLL(path.c_str(), "rb", &hooks));
  if (!file)
    throw FileError(fmt::format("{} is no shapefile, or damaged: expected one that libshp opens, found: {}", path,
                                said().empty() ? "no header of a shapefile" : trimmed(said())));
  return file;
}

std::string type_name(int type) {
  return SHPTypeName(type);
}

class ShapefileReader {
public:
  ShapefileReader(const std::string& path, std::string_view bytes) : path_(path), file_(open(path, bytes)) {
    contour_.source = path;
  }

  Contour read() {
    int records = 0, type = 0;
    SHPGetInfo(file_.get(), &records, &type, nullptr, nullptr);
    RingBuilder builder(contour_);
    for (int k = 0; k < records; ++k) {
      const Record record(SHPReadObject(file_.get(), k));
      if (!record)
        throw FileError(fmt::format("{}:{}: the record is damaged: expected {} records, found {} that can be read: {}",
                                    path_, k + 1, records, k, said().empty() ? "the file is too short" : said()));
      add(*record, k + 1, builder);
    }
    builder.finish("a shapefile with polygons");
    tell_skipped();
    return std::move(contour_);
  }

private:
  void add(const SHPObject& record, int number, RingBuilder& builder) {
    const int type = record.nSHPType;
    const bool is_line = type == SHPT_ARC || type == SHPT_ARCZ || type == SHPT_ARCM,
               is_polygon = type == SHPT_POLYGON || type == SHPT_POLYGONZ || type == SHPT_POLYGONM;
    if (type == SHPT_NULL)
      return;
    if (!is_line && !is_polygon) {
      if (++skipped_ == 1) {
        skipped_record_ = number;
        skipped_type_ = type_name(type);
      }
      return;
    }
    for (int part = 0; part < record.nParts; ++part) {
      const int first = record.panPartStart[part],
                end = part + 1 < record.nParts ? record.panPartStart[part + 1] : record.nVertices;
      if (first < 0 || end > record.nVertices || first >= end)
        throw FileError(fmt::format("{}:{}: part {} of the record is damaged: expected vertices within 0 to {}, found "
                                    "{} to {}",
                                    path_, number, part + 1, record.nVertices, first, end));
      const auto vertex = [&](int k) { return Vec2{record.padfX[k], record.padfY[k]}; };
      if (is_line && vertex(first) != vertex(end - 1))
        throw GeometryError(fmt::format("{}:{}: expected polygons, or lines that end where they start, at ({}, {}); "
                                        "found one that ends at ({}, {}): close it, or make a polygon of it",
                                        path_, number, vertex(first).x, vertex(first).y, vertex(end - 1).x,
                                        vertex(end - 1).y));
      for (int k = first; k < end; ++k)
        builder.add(vertex(k), number);
      builder.end_ring();
    }
  }

  void tell_skipped() {
    if (skipped_ > 0)
      contour_.warnings.push_back(fmt::format("{}:{}: {} record{} of type {}, here first, left out: only polygons and "
                                              "closed lines bound a shape",
                                              path_, skipped_record_, skipped_, skipped_ == 1 ? "" : "s",
                                              skipped_type_));
  }

  const std::string& path_;
  File file_;
  Contour contour_;
  int skipped_ = 0, skipped_record_ = 0;
  std::string skipped_type_;
};

} // namespace

Contour read_shapefile(const std::string& path, const std::string& hint) {
  const std::string bytes = read_file(path, hint); // the reason of the system if it cannot be opened
  Contour contour = ShapefileReader(path, bytes).read();
  if (const std::string prj = beside(path, ".prj", ".PRJ"); std::filesystem::exists(prj))
    contour.crs = std::string(trimmed(read_file(prj)));
  return contour;
}

} // namespace trime::shape
