#pragma once
#include "store/folder.h"

#include <filesystem>
#include <string>
#include <vector>

namespace lamella {

/// Polygons over time: NAME.pvd lists NAME_0000.vtp and so on for ParaView. A file is listed before
/// it is written, so that an export that is cut short leaves none that is not known as its own.
class SurfaceCollection {
public:
  SurfaceCollection(Folder folder, std::string name)
      : folder_(std::move(folder)), name_(std::move(name)) {}

  /// Those of a frame, by its number in the run. Throws StoreError.
  void add(std::size_t frame, double time, const std::string& vtp);
  /// Of the list. Throws StoreError.
  std::filesystem::path file() const { return folder_.path() / (name_ + ".pvd"); }
  /// Lists what there is, also if that is nothing. Throws StoreError.
  void write_list() const;

private:
  Folder folder_;
  std::string name_, entries_;
};

/// The files of an export in a folder: the lists that it wrote and what they list. Throws
/// StoreError.
std::vector<std::string> exported_files(const Folder& folder);

/// The name that a frame has in a collection.
std::string surface_file(const std::string& collection, std::size_t frame);

} // namespace lamella
