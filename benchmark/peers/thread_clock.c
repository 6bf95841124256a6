/* Makes a program that measures itself by std::chrono::steady_clock count the processor time of its thread, so that what others
 * run beside it does not count:
 *
 *   cc -O2 -shared -fPIC -o thread_clock.so thread_clock.c -ldl
 *   LD_PRELOAD=./thread_clock.so PROGRAM
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <time.h>

int clock_gettime(clockid_t clock, struct timespec* now) {
  static int (*real)(clockid_t, struct timespec*);
  if (!real) real = (int (*)(clockid_t, struct timespec*))dlsym(RTLD_NEXT, "clock_gettime");
  return real(clock == CLOCK_MONOTONIC ? CLOCK_THREAD_CPUTIME_ID : clock, now);
}
