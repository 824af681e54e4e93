//! What is integrated.

/// The right-hand side of y' = f(t, y). Every closure is one.
pub trait RightHandSide<const N: usize> {
    /// Why f could not be had.
    type Failure;

    /// How many components there are; y and f are 0 from there on.
    #[inline(always)]
    fn used(&self) -> usize {
        N
    }

    /// f(t, y).
    ///
    /// # Errors
    /// Where f is not defined or not finite.
    fn slope(&mut self, t: f64, y: &[f64; N]) -> Result<[f64; N], Self::Failure>;

    /// The same at number `probe` of [`super::dop853::PROBES`] in the step that is being tried, for who keeps what comes by the
    /// way there; the highest comes last.
    ///
    /// # Errors
    /// Those of [`Self::slope`].
    #[inline(always)]
    fn slope_at_probe(&mut self, probe: usize, t: f64, y: &[f64; N]) -> Result<[f64; N], Self::Failure> {
        let _ = probe;
        self.slope(t, y)
    }
}

impl<F, X, const N: usize> RightHandSide<N> for F
where
    F: FnMut(f64, &[f64; N]) -> Result<[f64; N], X>,
{
    type Failure = X;

    #[inline(always)]
    fn slope(&mut self, t: f64, y: &[f64; N]) -> Result<[f64; N], X> {
        self(t, y)
    }
}
