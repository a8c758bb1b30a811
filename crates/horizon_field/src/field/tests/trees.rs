//! Trees: files, refusals.

use crate::field::arbitrary::{Pictures, Random, every_kind, field};
use crate::field::{
    Clamp, Dual, Field, FieldError, Fractal, HeightImage, ImageDirectory, ImageField, ImageSource, Mask, NoImages,
    Noise, Remap, SmoothMin, Terrace, Triplanar,
};

#[test]
fn trees_survive_files() {
    let mut random = Random::new(2);
    let random = (0..200).map(|_| field(&mut random, 5));
    for field in every_kind(4).into_iter().map(|(_, field)| field).chain(random) {
        let text = ron::to_string(&field).unwrap();
        assert_eq!(ron::from_str::<Field>(&text).unwrap(), field, "{text}");
    }
}

#[test]
fn files_name_only_what_differs_from_the_default() {
    let text = "Add([Constant(5.0), Fractal((rule: Ridged, octaves: 7.5)), Warp((x: Noise((wavelength: 50.0))))])";
    let Field::Add(fields) = ron::from_str(text).unwrap() else { panic!() };
    assert!(matches!(&fields[1], Field::Fractal(f) if f.octaves == 7.5 && f.gain == Fractal::default().gain));
    for (text, names) in [
        ("Fractal((octave: 7.0))", "octave"),
        ("Fractal((octaves: \"many\"))", "1:19"),
        ("Fractle(())", "Fractle"),
        ("Add([Constant(1.0)", "1:"),
    ] {
        let error = ron::from_str::<Field>(text).unwrap_err().to_string();
        assert!(error.contains(names), "{error}");
    }
}

/// The error of a field that lies in a sum, after a good one.
fn refusal(field: impl Into<Field>) -> FieldError {
    let field = Field::Add(vec![Field::default(), field.into()]);
    let error = field.check().unwrap_err();
    // By text: NaN is not equal to itself.
    assert_eq!(field.compile::<2>(&NoImages).unwrap_err().to_string(), error.to_string());
    assert_eq!(field.compile::<3>(&NoImages).unwrap_err().to_string(), error.to_string());
    error
}

#[test]
fn what_is_out_of_range_is_named() {
    let fractal = Fractal::default();
    for (bad, name) in [
        (Fractal { gain: 1.0, ..fractal.clone() }, "gain"),
        (Fractal { gain: 0.0, ..fractal.clone() }, "gain"),
        (Fractal { lacunarity: 1.0, ..fractal.clone() }, "lacunarity"),
        (Fractal { lacunarity: -2.0, ..fractal.clone() }, "lacunarity"),
        (Fractal { lacunarity: 17.0, ..fractal.clone() }, "lacunarity"),
        (Fractal { octaves: -0.1, ..fractal.clone() }, "octaves"),
        (Fractal { octaves: 24.1, ..fractal.clone() }, "octaves"),
        (Fractal { wavelength: 0.0, ..fractal.clone() }, "wavelength"),
        (Fractal { offset: -1.0, ..fractal.clone() }, "offset"),
    ] {
        let error = refusal(bad);
        let FieldError::OutOfRange { path, .. } = &error else { panic!("{error}") };
        assert_eq!(*path, format!("field.Add[1].Fractal.{name}"));
    }
    let nan = refusal(Fractal { amplitude: f64::NAN, ..fractal.clone() });
    assert!(matches!(&nan, FieldError::NotFinite { path, .. } if path == "field.Add[1].Fractal.amplitude"), "{nan}");
    for (bad, path) in [
        (Field::Constant(f64::INFINITY), "field.Add[1].Constant is inf"),
        (Noise { wavelength: -1.0, ..Noise::default() }.into(), "field.Add[1].Noise.wavelength"),
        (ImageField { size: [1.0, 0.0], ..ImageField::default() }.into(), "field.Add[1].Image.size"),
        (SmoothMin { radius: 0.0, ..SmoothMin::default() }.into(), "field.Add[1].SmoothMin.radius"),
        (Terrace { step: 0.0, ..Terrace::default() }.into(), "field.Add[1].Terrace.step"),
        (Triplanar { sharpness: 0, ..Triplanar::default() }.into(), "field.Add[1].Triplanar.sharpness"),
        (Dual { low: 5.0, high: 5.0, ..Dual::default() }.into(), "field.Add[1].Dual runs from 5 to 5"),
        (Clamp { low: 6.0, high: 5.0, ..Clamp::default() }.into(), "field.Add[1].Clamp runs"),
        (Mask { low: 6.0, high: 5.0, ..Mask::default() }.into(), "field.Add[1].Mask runs"),
        (Remap { from: [2.0; 2], ..Remap::default() }.into(), "field.Add[1].Remap runs"),
        (Field::Min(vec![]), "field.Add[1].Min holds no field"),
        (
            Mask { inside: Field::Multiply(vec![]).into(), ..Mask::default() }.into(),
            "field.Add[1].Mask.inside.Multiply",
        ),
    ] {
        let error = refusal(bad).to_string();
        assert!(error.starts_with(path), "{error}");
    }
}

#[test]
fn what_is_too_much_is_refused() {
    let many = Field::Add(vec![Fractal { octaves: 20.0, ..Fractal::default() }.into(); 13]);
    assert_eq!(many.check(), Err(FieldError::TooManyOctaves { octaves: 260 }));
    assert_eq!(Field::Max(vec![Field::Constant(1.0); 2000]).check(), Err(FieldError::TooManyNodes));
    let high = Field::Multiply(vec![Field::Constant(1e6); 3]);
    assert!(matches!(high.compile::<2>(&NoImages), Err(FieldError::TooHigh { .. })));
    let overflow = Field::Multiply(vec![Field::Constant(1e6); 60]);
    assert!(matches!(overflow.compile::<3>(&NoImages), Err(FieldError::TooHigh { .. })));
}

fn chain(depth: usize) -> Field {
    (1..depth).fold(Field::Constant(1.0), |field, _| Clamp { field: field.into(), ..Clamp::default() }.into())
}

#[test]
fn deep_trees_are_refused_without_recursion() {
    assert_eq!(chain(64).check(), Ok(()));
    assert!(chain(64).compile::<3>(&NoImages).is_ok());
    assert!(matches!(chain(65).check(), Err(FieldError::TooDeep { .. })));
    let deep = chain(10_000);
    assert!(matches!(deep.compile::<2>(&NoImages), Err(FieldError::TooDeep { .. })));
    assert_eq!(deep.image_paths(), Vec::<String>::new());
    // And so are they in files.
    let text = "Add([".repeat(10_000);
    assert!(ron::from_str::<Field>(&text).is_err());
}

#[test]
fn images_that_cannot_be_had_are_named() {
    let image = |path: &str| Field::Min(vec![ImageField { path: path.into(), ..ImageField::default() }.into()]);
    let field = Field::Add(vec![image("small"), image("absent"), image("small")]);
    assert_eq!(field.image_paths(), ["small", "absent"]);
    let error = field.compile::<2>(&Pictures).unwrap_err();
    assert!(matches!(&error, FieldError::Image { path, .. } if path == "field.Add[1].Min[0].Image"), "{error}");

    struct Fixed(HeightImage);
    impl ImageSource for Fixed {
        fn load(&self, _: &str) -> Result<HeightImage, String> {
            Ok(self.0.clone())
        }
    }
    for (width, height, texels) in [(0, 0, 0), (8193, 1, 8193), (2, 2, 3)] {
        let image = Fixed(HeightImage { width, height, texels: vec![0; texels] });
        assert!(matches!(field.compile::<2>(&image), Err(FieldError::ImageSize { .. })));
    }
    let directory = ImageDirectory::new(".");
    for path in ["../secret.png", "/etc/passwd", "no such file.png"] {
        assert!(directory.load(path).is_err());
    }
}

#[test]
fn png_images_are_read() {
    use image::{ImageBuffer, Luma};
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture: ImageBuffer<Luma<u16>, _> = ImageBuffer::from_fn(3, 2, |x, y| Luma([(1000 * x + y) as u16]));
    picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    let read = HeightImage::from_png(bytes.get_ref()).unwrap();
    assert_eq!(read, HeightImage { width: 3, height: 2, texels: vec![0, 1000, 2000, 1, 1001, 2001] });
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture: ImageBuffer<Luma<u8>, _> = ImageBuffer::from_fn(1, 1, |_, _| Luma([255]));
    picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    assert_eq!(HeightImage::from_png(bytes.get_ref()).unwrap().texels, [65535]);
    assert!(HeightImage::from_png(&bytes.get_ref()[..40]).is_err());
    assert!(HeightImage::from_png(b"no image").is_err());
}
