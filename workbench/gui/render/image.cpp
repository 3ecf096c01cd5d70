#include "workbench/gui/render/image.h"

#include "core/io/atomic_file.h"

#include <epoxy/gl.h>
#include <stb_image_write.h>

#include <algorithm>

namespace tangent {

Image read_pixels(unsigned framebuffer, int width, int height) {
  Image image{width, height, {}};
  const std::size_t row = std::size_t{4} * static_cast<std::size_t>(width);
  image.rgba.resize(row * static_cast<std::size_t>(height));
  GLint before = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
  for (int y = 0; y < height / 2; ++y) {  // GL's rows count from the bottom
    std::swap_ranges(image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * y,
                     image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * (y + 1),
                     image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * (height - 1 - y));
  }
  return image;
}

Status write_png(const Image& image, const std::filesystem::path& path) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    rgb.insert(rgb.end(), {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
  }
  std::vector<char> bytes;
  const auto append = [](void* into, void* data, int size) {
    auto& out = *static_cast<std::vector<char>*>(into);
    out.insert(out.end(), static_cast<char*>(data), static_cast<char*>(data) + size);
  };
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, rgb.data(), 3 * image.width) == 0) {
    return fail("can't encode the picture", path.string(), "try a smaller size");
  }
  return write_file_atomic(path, {bytes.data(), bytes.size()});
}

}  // namespace tangent
