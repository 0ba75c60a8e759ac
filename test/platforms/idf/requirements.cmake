# tools/cmake/scripts/component_get_requirements.cmake:68 and :107: a component's file is included by a script, and
# registering returns from it.
macro(idf_component_register)
  set(registered 1)
  return()
endmacro()

include(${COMPONENT_DIR}/CMakeLists.txt OPTIONAL)
if(NOT registered)
  message(FATAL_ERROR "${COMPONENT_NAME} has not been registered")  # it would be missing without an error
endif()
