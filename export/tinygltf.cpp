// The one place where tinygltf is compiled.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
