/* SPDX-License-Identifier: MIT */
/* A library that is no FMU. */
int nothing;
