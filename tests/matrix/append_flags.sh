#!/bin/sh
# A compiler launcher: append_flags.sh "FLAGS" COMPILER ARGUMENTS. What comes last wins over the project's own flags.
# SPDX-License-Identifier: MIT
flags=$1
shift
# shellcheck disable=SC2086
exec "$@" $flags
