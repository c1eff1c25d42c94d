# A file NAME.js of a page, or NAME.py or NAME.cxx of an engine, becomes the text NAME_script in a library,
# without its first comment.
function(wscvt_embed_script library file)
  get_filename_component(file ${file} ABSOLUTE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} script)
  string(REGEX REPLACE "^((//|#)[^\n]*\n)+" "" script "${script}")
  file(CONFIGURE OUTPUT ${name}_script.cpp @ONLY CONTENT [[
namespace wscvt {
extern const char* const @name@_script;
const char* const @name@_script = R"JS(
@script@)JS";
}  // namespace wscvt
]])
  target_sources(${library} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${name}_script.cpp)
endfunction()
