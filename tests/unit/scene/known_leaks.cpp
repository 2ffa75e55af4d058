// What the address sanitizer is not to tell of. The name is the sanitizer's.

// Assimp forgets what it has read of a file that it then refuses.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libassimp.so";
}
