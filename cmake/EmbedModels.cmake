# Makes a C++ source of models, so that the program needs none of their files:
#   cmake -DMODELS=<models> -DNAMES=dextar,planar/3rpr -DOUTPUT=<template_models.cc> -P EmbedModels.cmake
string(REPLACE "," ";" NAMES "${NAMES}")
list(LENGTH NAMES count)
set(source "// Made by cmake/EmbedModels.cmake.\n#include \"corank/studio/template_models.h\"\n\nnamespace corank::studio {\n\n")
string(APPEND source "std::span<const TemplateModel> template_models() {\n  static constexpr TemplateModel kAll[] = {\n")
foreach(name IN LISTS NAMES)
  file(READ "${MODELS}/${name}.cuik" text)
  string(APPEND source "{\"${name}\", R\"corank_model(${text})corank_model\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "${source}};\n  return kAll;\n}\n\n}  // namespace corank::studio\n")
