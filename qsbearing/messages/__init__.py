"""What there is to say about solved cases, in sentences."""

from qsbearing.messages.bearing import message, warnings

__all__ = ["message", "warnings"]
