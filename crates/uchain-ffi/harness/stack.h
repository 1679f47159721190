/* How deep the calls go into the stack: measured on the chip, where it matters, and nothing on a host. */
#ifndef STACK_H
#define STACK_H

enum { STACK_STEP, STACK_SAY, STACK_HEAR, STACK_EXPLAIN, STACK_PARAMS, STACK_INIT, STACK_CALLS };

#ifdef ON_CHIP
/* Fills what is free of the stack below the caller. */
void stack_paint(void);
/* Looks how much of the paint is gone, and keeps the most for this call. */
void stack_look(int which);
void stack_report(void);
#define STACK_OF(which, call) \
    do { \
        stack_paint(); \
        call; \
        stack_look(which); \
    } while (0)
#else
#define STACK_OF(which, call) \
    do { \
        call; \
    } while (0)
#define stack_report() ((void)0)
#endif

#endif
