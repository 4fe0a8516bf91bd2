# Writes the stage's files for pages: the text, the script in two halves and the style, without indentation and without
# lines that are comments alone, and a page's policy, which names the digests of script and style (SHA-256). Run as:
# cmake -DFOLDER=<the stage's own files> -DOUTPUT=<folder of page.html, page.css, policy.html, first.js and second.js>
# -P join_page.cmake

# Computes a digest in base64 (RFC 4648, section 4): 42 times two letters, one letter for four bits, and a sign.
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

# The script is in two files, because C++ compilers need not accept a text of more than 65,536 letters.
set(script "// SPDX-License-Identifier: BSD-3-Clause\n\"use strict\";")
set(first data camera light caster)
set(second layers frames png messages viewer controls)
foreach(half first second)
  set(joined "")
  foreach(part IN LISTS ${half})
    file(READ ${FOLDER}/${part}.js text)
    string(APPEND joined "${text}")
  endforeach()
  string(REGEX REPLACE "(\n *//[^\n]*)+\n" "\n" joined "\n${joined}")
  string(REGEX REPLACE "\n +" "\n" joined "${joined}")
  string(APPEND script "${joined}")
  file(WRITE ${OUTPUT}/${half}.js "${script}")
  string(APPEND whole "${script}")
  set(script "")
endforeach()
file(REMOVE ${OUTPUT}/page.js)  # an earlier version wrote one file
file(WRITE ${OUTPUT}.js "${whole}")
file(READ ${FOLDER}/page.css style)
string(REGEX REPLACE "\n +" "\n" style "${style}")
file(WRITE ${OUTPUT}/page.css "\n${style}")

digest_of(SCRIPT_HASH ${OUTPUT}.js)
digest_of(STYLE_HASH ${OUTPUT}/page.css)
file(WRITE ${OUTPUT}/policy.html "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src ${SCRIPT_HASH}; \
style-src ${STYLE_HASH}; img-src data: blob:; base-uri 'none'; form-action 'none'\">")
configure_file(${FOLDER}/page.html ${OUTPUT}/page.html COPYONLY)
