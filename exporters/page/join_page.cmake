# Writes the page's files as pages have them: the script in one piece without lines that are comments alone, the style,
# and the text, whose policy names the SHA-256 digests of both.
# Run as: cmake -DFOLDER=<the page's own files> -DOUTPUT=<folder of page.html, page.css and page.js> -P join_page.cmake

# As policies have it (RFC 4648, section 4): 256 bits are 42 times two letters, a last one of four bits, and a sign.
function(digest_of variable file)
  set(letters "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
  file(SHA256 ${file} digits)
  string(APPEND digits "00")
  set(text "")
  foreach(first RANGE 0 63 3)
    string(SUBSTRING ${digits} ${first} 3 twelve_bits)
    math(EXPR upper "0x${twelve_bits} >> 6")
    math(EXPR lower "0x${twelve_bits} & 63")
    string(SUBSTRING ${letters} ${upper} 1 upper)
    string(SUBSTRING ${letters} ${lower} 1 lower)
    string(APPEND text ${upper}${lower})
  endforeach()
  string(SUBSTRING ${text} 0 43 text)
  set(${variable} "'sha256-${text}='" PARENT_SCOPE)
endfunction()

set(script "")
foreach(part data camera caster layers views png messages controls)
  file(READ ${FOLDER}/${part}.js text)
  string(APPEND script "${text}")
endforeach()
string(REGEX REPLACE "(\n *//[^\n]*)+\n" "\n" script "\n${script}")
file(WRITE ${OUTPUT}/page.js "// SPDX-License-Identifier: BSD-3-Clause\n\"use strict\";${script}")
file(READ ${FOLDER}/page.css style)
file(WRITE ${OUTPUT}/page.css "\n${style}")

digest_of(SCRIPT_HASH ${OUTPUT}/page.js)
digest_of(STYLE_HASH ${OUTPUT}/page.css)
file(READ ${FOLDER}/page.html page)
foreach(mark SCRIPT_HASH STYLE_HASH)
  string(REPLACE "@${mark}@" "${${mark}}" page "${page}")
endforeach()
file(WRITE ${OUTPUT}/page.html "${page}")
