# Everything comes from Debian 12 packages; scripts/packages.txt lists them with the reason for each.
find_package(embree 3 REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(assimp REQUIRED)
find_package(CGAL REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Threads REQUIRED)
find_library(OSMESA_LIBRARY OSMesa REQUIRED)
find_library(EGL_LIBRARY EGL REQUIRED)

# Debian's OpenImageIO names OpenCV's include folder, which is only there if OpenCV is; we don't use that part.
get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER oiio_includes EXCLUDE REGEX "opencv")
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${oiio_includes}")
