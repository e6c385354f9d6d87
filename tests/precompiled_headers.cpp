// Owns the precompiled headers of all tests (CMakeLists.txt); the program itself does nothing.
int main() { return 0; }
