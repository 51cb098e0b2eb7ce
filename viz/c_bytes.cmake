# SPDX-License-Identifier: MIT
# c_bytes(RESULT HEX): the initialisers of a C array of these bytes, sixteen a line. A string literal would not do: C
# promises 4095 characters of one, and no more.
function(c_bytes result hex)
  string(REPEAT "." 80 row) # sixteen bytes
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
  string(REGEX REPLACE "(${row})" "\\1\n" bytes "${bytes}")
  set(${result} "${bytes}" PARENT_SCOPE)
endfunction()
