/* Stands in for the firmware's header of this name, so that the app can be compiled and flown without the firmware: only
 * what the app uses. The real one comes from the firmware's tree. */
#ifndef FREERTOS_H
#define FREERTOS_H

#include <stdint.h>

typedef uint32_t TickType_t;

/* Milliseconds as ticks: the firmware ticks at 1 kHz. */
#define M2T(ms) ((TickType_t)(ms))

#endif
