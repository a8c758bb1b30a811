//! Numbers, ranges and presets.

use crate::clouds::{CloudError, CloudLayer, CloudModel};

const PRESETS: [CloudLayer; 4] = [CloudLayer::CUMULUS, CloudLayer::STRATUS, CloudLayer::STORM, CloudLayer::CIRRUS];

#[test]
fn presets_pass_and_differ() {
    for layer in PRESETS {
        assert_eq!(layer.check(), Ok(()));
    }
    assert_eq!(CloudLayer::default(), CloudLayer::CUMULUS);
    assert!(PRESETS.map(|layer| layer.model).contains(&CloudModel::Sheet));
}

#[test]
fn bad_numbers_are_named() {
    let layer = CloudLayer { coverage: f32::NAN, ..CloudLayer::CUMULUS };
    assert!(matches!(layer.check(), Err(CloudError::NotFinite { field: "coverage", .. })));
    let layer = CloudLayer { wind: [0.0, 1e9], ..CloudLayer::CUMULUS };
    assert!(matches!(layer.check(), Err(CloudError::OutOfRange { field: "wind", high: 200.0, .. })));
    let layer = CloudLayer { base: 2_200.0, ..CloudLayer::CUMULUS };
    assert_eq!(layer.check(), Err(CloudError::Flat { base: 2_200.0, top: 2_200.0 }));
    let said = CloudLayer { softness: 0.0, ..CloudLayer::CUMULUS }.check().expect_err("no edge").to_string();
    assert!(said.contains("softness") && said.contains("0.01"), "{said}");
}
