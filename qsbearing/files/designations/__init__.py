"""What a designation tells of a bearing: boundary dimensions, kind, contact angle; and what it does not tell."""

from qsbearing.files.designations.designation import Designation, angles_of, read

__all__ = ["Designation", "angles_of", "read"]
