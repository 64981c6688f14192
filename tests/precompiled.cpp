// Exists because a target with precompiled headers, which all tests reuse, needs a source file.
