// Memory that libraries keep to the end, for the leak sanitizer: CLN (of GiNaC) never frees a
// string.
extern "C" const char* __lsan_default_suppressions() { return "leak:libcln"; }
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
