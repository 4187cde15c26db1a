#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lamella {

/// A folder that files are written to, held open: it stays the same one whatever becomes of its
/// name. What is done through it happens to entries of this very folder: a symbolic link among them
/// is never followed. Copies share the one that is open. Failures throw StoreError.
class Folder {
public:
  /// One that a user names, perhaps by a symbolic link; the current one for an empty path.
  explicit Folder(const std::filesystem::path& path);

  /// One of ours in it, which is made where it is missing. A link or a file in its place is
  /// refused.
  Folder inner(const std::string& name) const;
  /// The same; nothing where it is missing.
  std::optional<Folder> find(const std::string& name) const;

  const std::filesystem::path& path() const { return path_; }
  /// Of an entry itself, not of what a link stands for.
  std::filesystem::file_type type_of(const std::string& name) const;
  /// All entries, in alphabetical order.
  std::vector<std::string> names() const;
  void refuse_read_only() const;

  /// Does nothing where there is no such file.
  void remove(const std::string& name) const;
  /// Does nothing where there is no such folder, or something in it.
  void remove_if_empty(const std::string& name) const;
  /// Gives a file another name in this folder; replaces what has that name.
  void rename(const std::string& from, const std::string& to) const;
  /// Makes renames last through a power failure. Some file systems cannot; files are whole all the
  /// same.
  void synchronise() const;

  enum class Sharing { shared, exclusive };
  /// Until the last copy is gone. False where another process has it; a file system without locks
  /// must do without.
  bool lock(Sharing sharing) const;
  /// Whether this still is what its path leads to.
  bool is_in_place() const;

  int descriptor() const { return *descriptor_; }

private:
  Folder(std::filesystem::path path, int descriptor);
  [[noreturn]] void refuse(const std::string& name, std::string_view what) const;

  std::filesystem::path path_;
  std::shared_ptr<const int> descriptor_; ///< closes it
};

/// Where a file is written: a name in a folder.
struct Place {
  Place(Folder in, std::string called) : folder(std::move(in)), name(std::move(called)) {}
  /// Of a path that a user gave.
  explicit Place(const std::filesystem::path& file);

  std::filesystem::path path() const { return folder.path() / name; }
  /// Throws StoreError for something else than a regular file, such as a link to one.
  void refuse_other_kinds() const;

  Folder folder;
  std::string name;
};

} // namespace lamella
