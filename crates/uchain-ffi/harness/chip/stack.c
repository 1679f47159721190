/* How deep a call goes into the stack: what is free below is painted, and looked at afterwards. No interrupt is on. */

#include "../stack.h"

#include <stdint.h>
#include <stdio.h>

enum { WORDS = 1024 };
static const uint32_t PAINT = 0xdeadbeefu;
static uint32_t *top;
static unsigned long most[STACK_CALLS];
static const char *const NAMES[STACK_CALLS] = {
    "uchain_step", "uchain_say", "uchain_hear", "uchain_explain", "uchain_params_...", "uchain_node_init",
};

__attribute__((noinline)) void stack_paint(void)
{
    uint32_t *at;
    __asm__ volatile("mov %0, sp" : "=r"(at));
    top = at;
    for (int i = 1; i <= WORDS; i++) {
        *(volatile uint32_t *)(top - i) = PAINT;
    }
}

__attribute__((noinline)) void stack_look(int which)
{
    uint32_t *at = top - WORDS;
    unsigned long bytes;
    while (at < top && *(volatile uint32_t *)at == PAINT) {
        at++;
    }
    bytes = (unsigned long)(top - at) * 4;
    if (bytes > most[which]) {
        most[which] = bytes;
    }
}

void stack_report(void)
{
    for (int i = 0; i < STACK_CALLS; i++) {
        printf("stack %s %lu bytes\n", NAMES[i], most[i]);
    }
}
