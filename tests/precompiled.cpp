// Compiled for the precompiled header alone, which the tests use.
