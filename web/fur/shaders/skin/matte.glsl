// Highlights of lamps end with the smoothness of the skin.
reflectedLight.directSpecular *= 1.0 - pow4(material.roughness);
