#include "workbench/gui/platform/ui_drawing.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include <cstddef>
#include <cstring>

namespace tangent {

namespace {

/// FNV-1a over words of eight bytes.
class Hash {
 public:
  void add(const void* data, std::size_t bytes) {
    const auto* at = static_cast<const unsigned char*>(data);
    for (; bytes >= 8; bytes -= 8, at += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, at, 8);
      mix(word);
    }
    for (; bytes > 0; --bytes, ++at) mix(*at);
  }
  template <class T>
  void add(const T& value) {
    add(&value, sizeof value);
  }
  std::uint64_t value() const { return value_; }

 private:
  void mix(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3u;
    value_ ^= value_ >> 29;
  }
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace

unsigned font_texture() { return static_cast<unsigned>(reinterpret_cast<std::intptr_t>(ImGui::GetIO().Fonts->TexID)); }

void use_nearest_pixels(unsigned font_texture) {
  glBindTexture(GL_TEXTURE_2D, font_texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glBindTexture(GL_TEXTURE_2D, 0);
}

bool UiDrawing::changed(const ImDrawData& data, std::uint64_t picture_version) {
  Hash hash;
  hash.add(picture_version);
  hash.add(data.DisplaySize);
  hash.add(data.FramebufferScale);
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    hash.add(list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.size_in_bytes()));
    hash.add(list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.size_in_bytes()));
    for (const ImDrawCmd& command : list.CmdBuffer) {
      hash.add(command.ClipRect);
      hash.add(command.TextureId);
      hash.add(command.ElemCount);
    }
  }
  const bool same = known_ && seen_ == hash.value();
  seen_ = hash.value();
  known_ = true;
  return !same;
}

void UiDrawing::draw(ImDrawData& data, const ImVec4& ground) {
  glClearColor(ground.x, ground.y, ground.z, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(&data);
}

}  // namespace tangent
