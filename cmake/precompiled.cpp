// Exists because a target with precompiled headers, which others reuse, needs a source file.
