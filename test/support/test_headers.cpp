// Empty: CMake compiles headers for all test programs (test/CMakeLists.txt) with a source of their own
// target.
