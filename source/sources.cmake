# SPDX-License-Identifier: LGPL-2.1-or-later

# Adds the files of a room to perideal_sources, and those of its LOOPS, in which runs spend their time, to
# perideal_loops too. Each room lists its files by name in its own sources.cmake.
function(perideal_room room)
  cmake_parse_arguments(PARSE_ARGV 1 room "" "" "SOURCES;LOOPS")
  if(room_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${room}/sources.cmake: neither SOURCES nor LOOPS: ${room_UNPARSED_ARGUMENTS}")
  endif()
  list(TRANSFORM room_SOURCES PREPEND "${room}/")
  list(TRANSFORM room_LOOPS PREPEND "${room}/")
  set(perideal_sources ${perideal_sources} ${room_SOURCES} ${room_LOOPS} PARENT_SCOPE)
  set(perideal_loops ${perideal_loops} ${room_LOOPS} PARENT_SCOPE)
endfunction()

# The rooms from the lowest floor. With PERIDEAL_UNITY neighbours in these lists are compiled as one. Files that define
# the same name in their unnamed namespaces, instantiate the same class or define the same macro are kept apart by
# unity_groups.cmake: a new file needs a line in the list of its room and no more. Where a group does not compile,
# mostly a name in an unnamed namespace is also that of a public class or function: give it one of its own.
foreach(room IN ITEMS
  base
  parameters
  geometry
  mesh
  nodes
  fem
  neighbourhood
  quadrature
  reconstruction
  output
  materials
  fracture
  boundary
  operators/weights
  operators/force
  operators/linear
  operators/system
  operators/post
  solvers
  treatments
  problem
  recorders
  drivers
  application)
  include(${room}/sources.cmake)
endforeach()
