# cmake -DCOMPILER=... -DNM=... -DOBJCOPY=... "-DOBJECTS=A.o;B.o" [-DONLY=PREFIX] -DOUT=... -P one_object.cmake
#
# Links the objects to one, in which only what is defined once can be seen from outside: whatever may be defined in
# several places (inline functions, templates; weak symbols) is decided here and becomes local. Not the tables of our
# classes with virtual functions, which a program's code refers to. With ONLY nothing is seen but symbols that begin so.
execute_process(COMMAND ${COMPILER} -r -nostdlib -fuse-ld=bfd -Wl,--force-group-allocation ${OBJECTS} -o ${OUT}.all
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${NM} --defined-only ${OUT}.all OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
if(ONLY)
  string(REGEX MATCHALL " [A-Zu] [^\n]+" weak "${symbols}")
  list(FILTER weak EXCLUDE REGEX " ${ONLY}")
else()
  string(REGEX MATCHALL " [WVu] [^\n]+" weak "${symbols}")
endif()
list(TRANSFORM weak REPLACE "^ . " "")
if(NOT ONLY)
  list(FILTER weak EXCLUDE REGEX "^_ZT[VIS]N7tangent")
endif()
list(JOIN weak "\n" weak)
file(WRITE ${OUT}.weak "${weak}\n")
execute_process(COMMAND ${OBJCOPY} --localize-symbols=${OUT}.weak ${OUT}.all ${OUT} COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE ${OUT}.all)
