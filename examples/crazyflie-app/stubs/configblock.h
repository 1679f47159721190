/* Stands in for the firmware's header of this name. The real one comes from the firmware's tree. */
#ifndef CONFIGBLOCK_H
#define CONFIGBLOCK_H

#include <stdint.h>

uint64_t configblockGetRadioAddress(void);

#endif
