# tangent_gui: the window, the off-screen renderer and everything drawn in them. The only room with GL and ImGui.
file(GLOB_RECURSE gui_sources CONFIGURE_DEPENDS gui/*.cpp)
add_library(tangent_gui STATIC ${gui_sources})
compile_folders_as_one(tangent_gui)

find_package(PkgConfig REQUIRED)
find_package(glfw3 3.3 REQUIRED)
find_package(Freetype REQUIRED)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(kissfft REQUIRED IMPORTED_TARGET kissfft-float)
find_path(IMGUI_INCLUDE imgui.h PATH_SUFFIXES imgui REQUIRED)
find_library(IMGUI_LIBRARY imgui REQUIRED)
find_path(STB_INCLUDE stb_image_write.h PATH_SUFFIXES stb REQUIRED)
find_library(STB_LIBRARY stb REQUIRED)

target_include_directories(tangent_gui SYSTEM PUBLIC ${IMGUI_INCLUDE} PRIVATE ${STB_INCLUDE})
# Debian's libimgui.a holds the core, the GLFW and OpenGL 3 back ends and the FreeType rasteriser, and
# leaves freetype and stb to whoever links it.
target_link_libraries(tangent_gui
  PUBLIC tangent_bench tangent_bringup tangent_evidence tangent_experiment tangent_recording tangent_sweep
         ${IMGUI_LIBRARY} glfw Freetype::Freetype ${STB_LIBRARY} PkgConfig::epoxy ${CMAKE_DL_LIBS}
  PRIVATE PkgConfig::kissfft)
# Places are known to one file each: all other objects are the same wherever the project lies (tests/README.md).
set_source_files_properties(gui/render/shader_program.cpp PROPERTIES COMPILE_DEFINITIONS
  TANGENT_SHADER_DIR="${PROJECT_SOURCE_DIR}/shaders")
set_source_files_properties(gui/model/shipped_presets.cpp PROPERTIES COMPILE_DEFINITIONS
  TANGENT_PRESET_DIR="${PROJECT_SOURCE_DIR}/presets")
