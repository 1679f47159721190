/* Stands in for FreeRTOS's header of this name. The real one comes from the firmware's tree. */
#ifndef TASK_H
#define TASK_H

#include "FreeRTOS.h"

void vTaskDelay(TickType_t ticks);
void vTaskDelayUntil(TickType_t *woken, TickType_t period);
TickType_t xTaskGetTickCount(void);

#endif
