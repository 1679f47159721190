/* Stands in for the firmware's header of this name: what the app asks the controllers for. Only the fields it sets. The real
 * one comes from the firmware's tree. */
#ifndef COMMANDER_H
#define COMMANDER_H

#include <stdbool.h>

typedef enum { modeDisable = 0, modeAbs, modeVelocity } stab_mode_t;

struct stub_vector {
    float x;
    float y;
    float z;
};

typedef struct {
    struct {
        stab_mode_t x;
        stab_mode_t y;
        stab_mode_t z;
        stab_mode_t yaw;
    } mode;
    /* m, from the ground up. */
    struct stub_vector position;
    /* m/s, in the body's frame if `velocity_body`: x ahead, y left. */
    struct stub_vector velocity;
    bool velocity_body;
    /* Degrees per second; yaw counter-clockwise. */
    struct {
        float yaw;
    } attitudeRate;
} setpoint_t;

void commanderSetSetpoint(setpoint_t *setpoint, int priority);

#endif
