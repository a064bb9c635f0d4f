# SPDX-License-Identifier: BSD-2-Clause
# cmake -DINPUT=page.html -DOUTPUT=page.cpp -DHEADER=display/page.h -DNAME=kPage -P embed.cmake
# Writes a source that defines pbrtmedia::NAME, the bytes of INPUT, as HEADER declares it. As numbers, since compilers
# need not take a literal of more than 65536 bytes.
file(READ ${INPUT} hex HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
file(WRITE ${OUTPUT} "// Made by cmake/embed.cmake.
#include \"${HEADER}\"

namespace pbrtmedia {
namespace {
constexpr unsigned char kBytes[] = {${bytes}};
}  // namespace
const std::string_view ${NAME}(reinterpret_cast<const char*>(kBytes), sizeof kBytes);
}  // namespace pbrtmedia
")
