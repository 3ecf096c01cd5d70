#include "workbench/gui/render/image.h"

#include "core/io/atomic_file.h"

#include <epoxy/gl.h>
#include <stb_image_write.h>

#include <algorithm>

namespace tangent {
namespace {

/// GL's rows count from the bottom.
void turn_over(Image& image) {
  const std::size_t row = std::size_t{4} * static_cast<std::size_t>(image.width);
  for (int y = 0; y < image.height / 2; ++y)
    std::swap_ranges(image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * y,
                     image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * (y + 1),
                     image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * (image.height - 1 - y));
}

}  // namespace

Image read_texture(unsigned texture, int width, int height) {
  Image image{width, height, {}};
  image.rgba.resize(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  turn_over(image);
  return image;
}

Image read_pixels(unsigned framebuffer, int width, int height) {
  Image image{width, height, {}};
  image.rgba.resize(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  GLint before = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
  turn_over(image);
  return image;
}

// Over black a pixel of colour c and alpha a is a c, over white a c + 1 - a.
Image with_alpha_of(const Image& over_black, const Image& over_white) {
  Image out = over_black;
  for (std::size_t i = 0; i + 3 < out.rgba.size(); i += 4) {
    int lighter = 255;  // by the white behind it; the least of three, each rounded
    for (std::size_t k = 0; k < 3; ++k)
      lighter = std::min(lighter, std::max(0, over_white.rgba[i + k] - over_black.rgba[i + k]));
    const int alpha = 255 - lighter;
    for (std::size_t k = 0; k < 3; ++k) {
      const int colour = alpha == 0 ? 0 : (255 * over_black.rgba[i + k] + alpha / 2) / alpha;
      out.rgba[i + k] = static_cast<std::uint8_t>(std::min(255, colour));
    }
    out.rgba[i + 3] = static_cast<std::uint8_t>(alpha);
  }
  return out;
}

Result<std::string> png_bytes(const Image& image, const PngOptions& options) {
  const std::size_t channels = options.alpha ? 4 : 3;
  std::vector<std::uint8_t> pixels;
  pixels.reserve(image.rgba.size() / 4 * channels);
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4)
    pixels.insert(pixels.end(), image.rgba.data() + i, image.rgba.data() + i + channels);
  std::string bytes;
  const auto append = [](void* into, void* data, int size) {
    static_cast<std::string*>(into)->append(static_cast<char*>(data), static_cast<std::size_t>(size));
  };
  const int components = static_cast<int>(channels);
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, components, pixels.data(),
                             components * image.width) == 0) {
    return fail("can't encode the picture", "PNG", "try a smaller size");
  }
  return png_with_origin(bytes, options.origin);
}

Status write_png(const Image& image, const std::filesystem::path& path, const PngOptions& options) {
  Result<std::string> bytes = png_bytes(image, options);
  if (bytes) return write_file_atomic(path, *bytes);
  bytes.error().where = path.string();
  return tl::unexpected(bytes.error());
}

}  // namespace tangent
