"""Errors whose message is a sentence for the user."""

from furbake.asset.planes import PlaneError
from furbake.asset.read import AssetError
from furbake.asset.store import StoreError
from furbake.batch.crew import MemoryShortError
from furbake.cluster.versions import ClusterError
from furbake.device import DeviceError
from furbake.imported.curves import GroomError
from furbake.options import OptionError
from furbake.page import PageError
from furbake.rti.relit import RtiError
from furbake.study.verify.pathtrace import VerifyError
from furbake.surface.mesh import MeshError
from furbake.usd.stage import UsdError

TOLD = (
    OptionError, MeshError, StoreError, AssetError, PlaneError, VerifyError, GroomError, PageError, ClusterError,
    DeviceError, MemoryShortError, RtiError, UsdError,
)  # fmt: skip
"""Errors whose message is a sentence for the user."""
