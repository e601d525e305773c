// A control that the gate must see on x86: arithmetic that a compiler may move out of the environment set for it.
// SPDX-License-Identifier: MIT
float quotient_in_a_scope(float a, float b) {
  unsigned caller;
  const unsigned pinned = 0x1f80;
  __asm__ volatile("stmxcsr %0" : "=m"(caller) : : "memory");
  __asm__ volatile("ldmxcsr %0" : : "m"(pinned) : "memory");
  const float result = a / b;
  __asm__ volatile("ldmxcsr %0" : : "m"(caller) : "memory");
  return result;
}
