# Makes the manual pages of corank and of its subcommands, and the words that bash completes, from what the program says of itself:
#   cmake -DPROGRAM=<corank> -DHELP2MAN=<help2man> -DGZIP=<gzip> -DVERSION=0.1.0 -DFOLDER=<output> -P Manual.cmake
cmake_minimum_required(VERSION 3.25)

function(run variable)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE text ERROR_VARIABLE error RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${error}")
  endif()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# The page NAME.1; its examples keep their lines.
function(page name command description)
  run(text ${HELP2MAN} --no-info "--version-string=corank ${VERSION}" "--name=${description}" "${command}")
  string(TOUPPER ${name} title)
  string(REGEX REPLACE "\n.TH [A-Z0-9-]+" "\n.TH ${title}" text "${text}")
  string(REGEX REPLACE "\n.SH NAME\n[^ ]+ " "\n.SH NAME\n${name} " text "${text}")
  string(REGEX REPLACE "\n(corank [a-z]+ )" "\n.br\n\\1" text "${text}")
  string(REGEX REPLACE "\n +--" "\n.br\n--" text "${text}")
  file(WRITE ${FOLDER}/${name}.1 "${text}")
  run(nothing ${GZIP} -9n ${FOLDER}/${name}.1)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(help ${PROGRAM} --help)
page(corank ${PROGRAM} "all singularities of a robot mechanism, each with a proof")
get_filename_component(programs ${PROGRAM} DIRECTORY)
foreach(other "cuik:encloses the solutions of a system in boxes, as the CUIK suite's program"
              "cuikequations:writes the equations of a mechanism, as the CUIK suite's program"
              "cuikplot3d:draws boxes for Geomview, as the CUIK suite's program"
              "cuikatan2:turns sines and cosines into angles, as the CUIK suite's program")
  string(REGEX MATCH "^([a-z0-9]+):(.*)$" matched "${other}")
  page(${CMAKE_MATCH_1} ${programs}/${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
endforeach()
string(REGEX REPLACE ".*\nSubcommands:\n" "" list "${help}")
string(REGEX REPLACE "\n\n.*" "" list "${list}")
string(REGEX REPLACE "\n          +" " " list "${list}")
string(REGEX MATCHALL "(^|\n)  [a-z]+ +[^\n]+" list "${list}")
set(subcommands "")
set(cases "")
foreach(line IN LISTS list)
  string(REGEX REPLACE "^\n?  ([a-z]+) +(.*)$" "\\1;\\2" parts "${line}")
  list(POP_FRONT parts subcommand)
  list(JOIN parts "," description)
  string(APPEND subcommands " ${subcommand}")
  page(corank-${subcommand} "${PROGRAM} ${subcommand}" "${description}")
  run(help ${PROGRAM} ${subcommand} --help)
  string(REGEX MATCHALL "\n  -[^\n {]+( TEXT:{[^}]*})?" options "${help}")
  set(words "")
  foreach(option IN LISTS options)
    string(REGEX MATCHALL "--?[A-Za-z][a-z-]*" names "${option}")
    if(option MATCHES " TEXT:{(.*)}")
      string(REGEX REPLACE "[, \n]+" " " values "${CMAKE_MATCH_1}")
      list(GET names 0 first)
      list(FILTER names INCLUDE REGEX "^-")
      foreach(name IN LISTS names)
        string(FIND "${option}" "{" brace)
        string(FIND "${option}" "${name}" at)
        if(at LESS brace)
          string(APPEND cases "    ${subcommand}:${name}) words='${values}' ;;\n")
          string(APPEND words " ${name}")
        endif()
      endforeach()
    else()
      list(JOIN names " " names)
      string(APPEND words " ${names}")
    endif()
  endforeach()
  string(STRIP "${words}" words)
  string(APPEND cases "    ${subcommand}:*) [[ $current == -* ]] && words='${words}' ;;\n")
endforeach()
string(STRIP "${subcommands}" subcommands)
file(WRITE ${FOLDER}/corank.bash "# bash completion of corank; made from its help.
_corank() {
  local current=\${COMP_WORDS[COMP_CWORD]} words=''
  if [[ $COMP_CWORD -eq 1 ]]; then
    COMPREPLY=($(compgen -W '${subcommands} --help --version' -- \"$current\"))
    return
  fi
  case \${COMP_WORDS[1]}:\${COMP_WORDS[COMP_CWORD - 1]} in
${cases}  esac
  if [[ -n $words ]]; then
    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))
  else
    COMPREPLY=($(compgen -f -- \"$current\"))
  fi
}
complete -o filenames -F _corank corank
")
