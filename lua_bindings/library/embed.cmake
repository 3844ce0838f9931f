# Writes OUTPUT, a C++ table of the modules below FOLDER: name ("csg.gears") and text. Run as
#   cmake -DFOLDER=... -DOUTPUT=... -P embed.cmake
file(GLOB_RECURSE paths RELATIVE ${FOLDER} ${FOLDER}/*.lua)
list(SORT paths)
set(table "#include \"lua_bindings/shipped_modules.h\"\n\nnamespace csgrun {\nnamespace {\n\n")
string(APPEND table "constexpr ShippedModule kModules[] = {\n")
foreach(path ${paths})
  file(READ ${FOLDER}/${path} text)
  string(REGEX REPLACE "\\.lua$" "" name ${path})
  string(REPLACE "/" "." name ${name})
  string(APPEND table "    {\"${name}\", R\"=lua=(${text})=lua=\"},\n")
endforeach()
string(APPEND table "};\n\n}  // namespace\n\n"
       "std::span<const ShippedModule> shipped_modules() { return kModules; }\n\n"
       "}  // namespace csgrun\n")
file(WRITE ${OUTPUT} "${table}")
