# Writes OUT, a source with the SHA-256 of ARCHIVE, the library that computes ticks.
file(SHA256 "${ARCHIVE}" digest)
file(WRITE "${OUT}" "#include \"workbench/recording/core_digest.h\"\n\n"
  "namespace tangent {\n\nconst char* core_digest() { return \"${digest}\"; }\n\n}  // namespace tangent\n")
