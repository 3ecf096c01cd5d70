# For Doxygen: what stands at the top of a header in lines of // is the documentation of that file.
FNR == 1 && /^\/\/ / {
  print FILENAME ~ /\/tangent\.h$/ ? "/// \\mainpage" : "/// \\file"
  print "///"
  top = 1
}
!/^\/\// { top = 0 }
top { sub(/^\/\//, "///") }
{ print }
