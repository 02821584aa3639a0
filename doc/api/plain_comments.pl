# For Doxygen: comments are plain text, in which < and \ are themselves.
while (<>) {
  s{(///<?)(.*)}{my ($mark, $text) = ($1, $2); $text =~ s/([\\<])/\\$1/g; "$mark$text"}e;
  print;
}
