# Writes the program's own pages into a folder for share/: manual pages, compressed, and the completion of shells; with
# the manual pages of programs that do not write any.
# Run as: cmake -DPROGRAM=<meniscus> -DPAGES=<folder> -DFOLDER=<folder> -DGZIP=<gzip> -P make_share.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}/man/man1" "${FOLDER}/man/man7")

file(GLOB others "${PAGES}/*.1")
file(COPY ${others} DESTINATION "${FOLDER}/man")
execute_process(COMMAND "${PROGRAM}" help --man "${FOLDER}/man" COMMAND_ERROR_IS_FATAL ANY)
foreach(section 1 7)
  file(GLOB pages "${FOLDER}/man/*.${section}")
  execute_process(COMMAND "${GZIP}" -9n ${pages} COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB pages "${FOLDER}/man/*.${section}.gz")
  file(COPY ${pages} DESTINATION "${FOLDER}/man/man${section}")
  file(REMOVE ${pages})
endforeach()

# One program has two names.
file(CREATE_LINK meniscus-pdb_to_xyzr.1.gz "${FOLDER}/man/man1/meniscus-pdb_to_xyzrn.1.gz" SYMBOLIC)

# These are the folders where Debian's shells look.
set(shells bash zsh fish)
set(paths bash-completion/completions/meniscus zsh/vendor-completions/_meniscus fish/vendor_completions.d/meniscus.fish)
foreach(shell path IN ZIP_LISTS shells paths)
  execute_process(COMMAND "${PROGRAM}" completion ${shell} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE "${FOLDER}/${path}" "${text}")
endforeach()
