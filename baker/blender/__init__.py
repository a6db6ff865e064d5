"""Extension of Blender: real-time fur by furbake, from the body and the hairs that an artist has made."""

import bpy

from .bake import FURBAKE_OT_bake, FURBAKE_OT_cancel, stop
from .panel import FURBAKE_PT_fur, import_entry
from .settings import FurPreferences, FurSettings
from .show import FURBAKE_OT_open, close
from .take import FURBAKE_OT_take

CLASSES = (
    FurSettings, FurPreferences, FURBAKE_OT_bake, FURBAKE_OT_cancel, FURBAKE_OT_open, FURBAKE_OT_take, FURBAKE_PT_fur,
)  # fmt: skip


def register() -> None:
    """Called by Blender when the extension is turned on."""
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Object.furbake = bpy.props.PointerProperty(type=FurSettings)
    bpy.types.TOPBAR_MT_file_import.append(import_entry)


def unregister() -> None:
    """Called by Blender when the extension is turned off."""
    stop()
    close()
    bpy.types.TOPBAR_MT_file_import.remove(import_entry)
    del bpy.types.Object.furbake
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
