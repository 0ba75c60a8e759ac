# The program of all three platforms: the page's code, as C++11, and the code that drives it. PAGE: the file with the page's code.
function(add_receiver)  # LIBRARIES...
  add_library(page OBJECT ${PAGE})
  set_target_properties(page PROPERTIES CXX_STANDARD 11 CXX_EXTENSIONS OFF)
  target_link_libraries(page PRIVATE ${ARGN})
  add_executable(receiver ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/Receiver.cpp $<TARGET_OBJECTS:page>)
  set_target_properties(receiver PROPERTIES CXX_STANDARD 17)
  target_include_directories(receiver PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..)
  target_link_libraries(receiver PRIVATE ${ARGN})
endfunction()
