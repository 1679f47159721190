/* From reset to main, on an STM32F405 under a debugger or an emulator that answers semihosting. */

#include <stdint.h>
#include <stdlib.h>

extern uint32_t stack_top, data_from, data_start, data_end, bss_start, bss_end;
extern void initialise_monitor_handles(void);
int main(int argc, char **argv);
void reset(void);
void fault(void);

/* Where the stack begins, then where to go after a reset and at each kind of fault. */
struct vectors {
    uint32_t *stack;
    void (*handlers[15])(void);
};

__attribute__((section(".vectors"), used)) static const struct vectors vectors = {
    &stack_top, { reset, fault, fault, fault, fault, fault },
};

/* Coprocessor access control: the floating point unit is number 10 and 11. */
#define CPACR (*(volatile uint32_t *)0xe000ed88u)

static char line[256];
static char *words[16];

static uintptr_t semihosting(uint32_t what, const void *with)
{
    register uintptr_t r0 __asm__("r0") = what;
    register const void *r1 __asm__("r1") = with;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

/* The command line in words, the first of them the program's name. */
static int command_line(void)
{
    struct { char *text; uint32_t size; } block = { line, sizeof line };
    int count = 0;
    if (semihosting(0x15, &block) != 0) {
        return 0;
    }
    for (char *at = line; *at != 0 && count < 15; ) {
        words[count++] = at;
        while (*at != 0 && *at != ' ') {
            at++;
        }
        while (*at == ' ') {
            *at++ = 0;
        }
    }
    return count;
}

void reset(void)
{
    CPACR |= 0xfu << 20;
    __asm__ volatile("dsb\n isb");
    for (uint32_t *from = &data_from, *to = &data_start; to < &data_end; ) {
        *to++ = *from++;
    }
    for (uint32_t *to = &bss_start; to < &bss_end; ) {
        *to++ = 0;
    }
    initialise_monitor_handles();
    exit(main(command_line(), words));
}

/* A fault ends the program, badly. */
void fault(void)
{
    static const uint32_t failed[2] = { 0x20023, 1 };
    semihosting(0x20, failed);
    for (;;) {
    }
}

/* exit() calls these where other start-up code brings them. */
void _init(void);
void _init(void) {}
void _fini(void);
void _fini(void) {}
