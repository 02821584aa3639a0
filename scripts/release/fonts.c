// Loaded with a Cairo that a release brings along. On a machine that has no fonts set up, Cairo's own strokes would stand for letters, and
// for a minus nothing: there, and only there, the fonts beside this library are used.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

__attribute__((constructor)) static void offer_fonts(void) {
  if (getenv("FONTCONFIG_FILE") || getenv("FONTCONFIG_PATH") || access("/etc/fonts/fonts.conf", R_OK) == 0) return;
  Dl_info here;
  if (!dladdr((void*)offer_fonts, &here) || !here.dli_fname) return;
  const char* const slash = strrchr(here.dli_fname, '/');
  if (!slash) return;
  char path[4096];
  const int length = snprintf(path, sizeof path, "%.*s/fonts/fonts.conf", (int)(slash - here.dli_fname), here.dli_fname);
  if (length > 0 && (size_t)length < sizeof path && access(path, R_OK) == 0) setenv("FONTCONFIG_FILE", path, 0);
}
