#ifndef LIGHT_FIELD_DEPTH_IO_FILES_H
#define LIGHT_FIELD_DEPTH_IO_FILES_H

#include <filesystem>
#include <functional>
#include <string>

namespace light_field_depth
{
/// The whole content of a file. @throw InputError if it cannot be read
std::string readFile(const std::filesystem::path& path);

/// Lets `write` fill a temporary file beside `path`, of the same extension, and then renames it, so that
/// nobody ever sees half a file. The temporary file is removed when `write` throws.
/// @throw InputError if the file cannot be renamed; whatever `write` throws
void writeWhole(const std::filesystem::path& path,
                const std::function<void(const std::filesystem::path& temporary)>& write);

/// Writes a text or a block of bytes as a whole. @throw InputError if it cannot be written
void writeFile(const std::filesystem::path& path, const std::string& content);

/// Creates a folder and its parents if need be. @throw InputError if that is not possible
void makeFolder(const std::filesystem::path& folder);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_FILES_H
