//! The Pareto front of cost and error: what nothing else beats in both.

use thiserror::Error;

/// Why there is no front.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("point {index} is not a number")]
pub struct NotANumber {
    /// The point's index.
    pub index: usize,
}

/// The indices of the points `(cost, error)` that no other point dominates, from the cheapest on. A point dominates
/// another that is worse in one respect and no better in the other; of equal points the first one stays.
pub fn front(points: &[(f64, f64)]) -> Result<Vec<usize>, NotANumber> {
    if let Some(index) = points.iter().position(|(cost, error)| cost.is_nan() || error.is_nan()) {
        return Err(NotANumber { index });
    }
    let mut order: Vec<usize> = (0..points.len()).collect();
    // A stable sort: of equals the first one comes first.
    order.sort_by(|&a, &b| points[a].partial_cmp(&points[b]).expect("no point is NaN"));
    let mut best = f64::INFINITY;
    let mut front = Vec::new();
    for index in order {
        let error = points[index].1;
        if error < best || front.is_empty() {
            best = error;
            front.push(index);
        }
    }
    Ok(front)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dominated_points_are_left_out() {
        let points = [(3.0, 1.0), (1.0, 5.0), (2.0, 5.5), (2.0, 2.0), (4.0, 1.5), (2.5, 2.0)];
        assert_eq!(front(&points), Ok(vec![1, 3, 0]));
        assert_eq!(front(&[]), Ok(vec![]));
        assert_eq!(front(&[(1.0, f64::INFINITY)]), Ok(vec![0]));
    }

    #[test]
    fn of_ties_the_better_and_then_the_first_stays() {
        assert_eq!(front(&[(1.0, 2.0), (1.0, 1.0), (1.0, 1.0)]), Ok(vec![1]));
        assert_eq!(front(&[(2.0, 1.0), (1.0, 1.0)]), Ok(vec![1]));
        assert_eq!(front(&[(0.0, 1.0), (-0.0, 1.0)]), Ok(vec![0]));
    }

    #[test]
    fn what_is_not_a_number_is_refused() {
        assert_eq!(front(&[(1.0, 1.0), (2.0, f64::NAN)]), Err(NotANumber { index: 1 }));
        assert_eq!(front(&[(f64::NAN, 1.0)]), Err(NotANumber { index: 0 }));
    }
}
