// An image in memory, and writing it as a PNG file (stb).
#pragma once

#include "core/base/result.h"
#include "workbench/session/file_origin.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tangent {

/// RGBA, 8 bits a channel, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;

  const std::uint8_t* at(int x, int y) const {
    return rgba.data() +
           4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

/// Colour of a framebuffer object (0: the window). Needs a current GL context.
Image read_pixels(unsigned framebuffer, int width, int height);

/// Colour of a texture of this size. Needs a current GL context.
Image read_texture(unsigned texture, int width, int height);

/// The picture whose pixels were drawn over black and over white: colour and alpha of each, straight. Precondition: the
/// same size.
Image with_alpha_of(const Image& over_black, const Image& over_white);

struct PngOptions {
  bool alpha = false;  ///< else opaque
  FileOrigin origin;
};
/// The bytes of a PNG file. Fails on a size that can't be encoded.
Result<std::string> png_bytes(const Image& image, const PngOptions& options = {});
/// Writes atomically (core/io/atomic_file.h). Fails when the file can't be written.
Status write_png(const Image& image, const std::filesystem::path& path, const PngOptions& options = {});

}  // namespace tangent
