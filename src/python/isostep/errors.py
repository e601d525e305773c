"""The library's errors as exceptions."""

# SPDX-License-Identifier: MIT


class Error(Exception):
    """A call of the library that did not succeed, and changed nothing. `status`: its number in C."""

    def __init__(self, status, text):
        super().__init__(text)
        self.status = status


class Refused(Error):
    """The world refuses a command: `command`, `field` and `expected` say what of it, and why."""

    def __init__(self, status, text, command="", field="", expected=""):
        super().__init__(status, text)
        self.command, self.field, self.expected = command, field, expected


class WrongScalar(Error):
    """A function of one scalar was given a world of another."""


class NoScalar(Error):
    """This library was built without the scalar."""


class Corrupt(Error):
    """Bytes that are not what they should be."""


class Closed(Error):
    """An object that was closed before."""


_BY_STATUS = {-2: WrongScalar, -3: NoScalar, -6: Corrupt, -9: Closed}


def error_of(status, text):
    """The exception of a status below 0 or, without a world that could say more, above."""
    kind = Refused if status > 0 else _BY_STATUS.get(status, Error)
    return kind(status, text)
