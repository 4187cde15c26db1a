#pragma once

/// What the plugin does when it is loaded, in every process: colours of its arrays; drawing without a
/// display where there is none.
void lamellaStartUp();
