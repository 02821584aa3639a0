# Makes a C++ source of the files of report/page/, so that the program needs none of them:
#   cmake -DPAGE=<report/page> -DTHREE=<three.js> -DMODULES=a.js,b.js -DFAMILY_MODULES=a.js,c.js -DPATH_MODULES=a.js,d.js
#         -DGALLERY_MODULES=a.js,e.js -DSTUDIO_MODULES=a.js,f.js -DOUTPUT=<page_assets.cc> -P EmbedPage.cmake
# The modules of a page become one: their imports of one another and the word `export` go, so names are distinct over all of them.
# How a page begins and ends, {{>head}} and {{>end}}, is in files of its own.
function(literal name text)
  set(result "const std::string_view ${name} = R\"corank_page(${text})corank_page\";\n\n" PARENT_SCOPE)
endfunction()

function(join name modules)
  string(REPLACE "," ";" modules "${modules}")
  set(script "")
  foreach(module IN LISTS modules)
    file(READ "${PAGE}/${module}" text)
    string(REGEX REPLACE "(^|\n)import [^;]*;" "\\1" text "${text}")
    string(REGEX REPLACE "\nexport " "\n" text "${text}")
    string(APPEND script "${text}\n")
  endforeach()
  set(${name} "${script}" PARENT_SCOPE)
endfunction()

file(READ "${PAGE}/page.html" template)
file(READ "${PAGE}/page.css" style)
file(READ "${PAGE}/card.html" card)
file(READ "${PAGE}/family.html" family)
file(READ "${PAGE}/family.css" family_style)
file(READ "${PAGE}/path.html" path)
file(READ "${PAGE}/path.css" path_style)
file(READ "${PAGE}/gallery.html" gallery)
file(READ "${PAGE}/gallery.css" gallery_style)
file(READ "${PAGE}/studio.html" studio)
file(READ "${PAGE}/studio.css" studio_style)
file(READ "${PAGE}/head.html" head)
file(READ "${PAGE}/end.html" end)
foreach(page template family path gallery studio)
  string(REPLACE "{{>head}}\n" "${head}" ${page} "${${page}}")
  string(REPLACE "{{>end}}\n" "${end}" ${page} "${${page}}")
endforeach()
file(READ "${THREE}" three)
join(script "${MODULES}")
join(family_script "${FAMILY_MODULES}")
join(path_script "${PATH_MODULES}")
join(gallery_script "${GALLERY_MODULES}")
join(studio_script "${STUDIO_MODULES}")

set(source "// Made by cmake/EmbedPage.cmake.\n#include \"corank/report/html/page_assets.h\"\n\nnamespace corank::report {\n\n")
foreach(item template:kPageTemplate style:kPageStyle script:kPageScript card:kCardTemplate family:kFamilyTemplate
             family_style:kFamilyStyle family_script:kFamilyScript path:kPathTemplate path_style:kPathStyle path_script:kPathScript
             gallery:kGalleryTemplate gallery_style:kGalleryStyle gallery_script:kGalleryScript
             studio:kStudioTemplate studio_style:kStudioStyle studio_script:kStudioScript three:kThree)
  string(REPLACE ":" ";" item "${item}")
  list(GET item 0 variable)
  list(GET item 1 name)
  literal(${name} "${${variable}}")
  string(APPEND source "${result}")
endforeach()
file(WRITE "${OUTPUT}" "${source}}  // namespace corank::report\n")
