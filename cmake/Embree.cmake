# Embree 4 where it is installed, otherwise 3; shadow/embree.h knows what differs.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
    find_package(embree 3 REQUIRED)
endif()
